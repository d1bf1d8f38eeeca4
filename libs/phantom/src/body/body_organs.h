#pragma once
/// \file The body's organs, part by part.

#include "body/organ.h"

#include "ostia/phantom/body.h"
#include "ostia/phantom/vessel_field.h"

#include <memory>

namespace ostia::phantom {

using Noise = std::shared_ptr<const NoiseField>;

/// A place in the heart's own directions, mm from its base.
struct HeartFrame {
  explicit HeartFrame(const HeartShape& heart);
  Vec3 world(double right_mm, double up_mm, double along_mm) const;
  /// x: (right - centre), sheared along the long axis by `shear` a mm, over semi-axes.
  Distance ellipsoid_at(const Vec3& centre, const Vec3& semi_axes, double shear = 0.0) const;
  HeartShape heart;
  geometry::Mat3 axes;                         ///< columns right, up, along
  double wide = 1.0, high = 1.0, long_ = 1.0;  ///< sizes over the usual ones (46, 40 and 92 mm)
};

/// Inside of the aortic root with its three sinuses, from the outflow tract to above the junction.
Distance aortic_root(const AorticRoot& root, double wall_mm);
Capsules aorta_above_root(const HeartShape& heart);
/// The outside of ventricles, atria and root, for pictures.
Distance heart_outline(const HeartShape& heart);

/// Great cardiac vein with the coronary sinus, middle cardiac vein, and veins beside larger branches: each
/// clear of every artery's outer wall.
/// `warp`: what the heart is bent by, or null. `closeness`: Obstacles::vein_closeness.
Capsules coronary_veins(const HeartShape& heart, const CoronaryTree& tree, const VesselField& field,
                        const HeartWarp* warp, double closeness);

/// Lobes of auricles, atria and pulmonary trunk that touch an artery's outer wall, with their walls.
/// Nothing where `options.lobes` is 0.
void add_lobes(Organs& organs, const HeartShape& heart, const CoronaryTree& tree, const VesselField& field,
               const HeartWarp* warp, const BodyOptions& options);

void add_aorta(Organs& organs, const HeartShape& heart, const TissueHu& hu);
/// Fat about the arteries and veins; before the chambers, so that none takes an artery.
/// `thickness`: Obstacles::groove_fat.
void add_groove_fat(Organs& organs, const CoronaryTree& tree, const Capsules& veins, const TissueHu& hu,
                    double thickness);
void add_chambers(Organs& organs, const HeartShape& heart, const BodyOptions& options, const Noise& noise);
void add_great_vessels(Organs& organs, const TissueHu& hu);
void add_heart_walls(Organs& organs, const HeartShape& heart, const TissueHu& hu, const Noise& noise);
/// Spine, sternum and ribs; before the mediastinum, which lies about the spine.
void add_bones(Organs& organs, const TissueHu& hu);
void add_mediastinum(Organs& organs, const TissueHu& hu, const Noise& noise);
void add_lungs(Organs& organs, const TissueHu& hu, std::uint64_t seed);
void add_chest_wall(Organs& organs, const TissueHu& hu, std::uint64_t seed);

// What patients carry, in the phantom's own heart and chest.
/// A loop of wire about the sternum with its knot in front.
Capsules sternal_wire(double height_mm);
/// Where the left internal mammary artery lies, behind the sternum's edge.
Vec3 mammary_bed(double height_mm);
/// Through the superior cava to the right ventricle's apex (0) or the right atrium's appendage (1).
Capsules pacing_lead(const HeartShape& heart, int which);

}  // namespace ostia::phantom
