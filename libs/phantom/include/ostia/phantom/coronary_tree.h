#pragma once
/// \file Coronary arteries with exact lumina, walls and plaques.

#include "ostia/geometry/centerline.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/phantom/anatomy.h"
#include "ostia/phantom/heart.h"
#include "ostia/phantom/radial_profile.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::phantom {

enum class Dominance { right, left, balanced };

enum class PlaqueKind {
  soft,
  fibrous,
  calcified,
  mixed
};                                  ///< mixed: calcified cores within soft or fibrous plaque
const char* word(PlaqueKind kind);  ///< "soft", "fibrous", "calcified", "mixed"

/// A body of plaque between lumen and outer wall: |s - s_centre| < length / 2, |theta - theta_centre| <
/// extent / 2, with tapered ends; calcified ones are lenses, thinner towards their rims too.
struct Plaque {
  PlaqueKind kind = PlaqueKind::soft;
  double s_centre_mm = 0.0, length_mm = 0.0;
  double theta_centre = 0.0, theta_extent = 0.0;  ///< rad
  double depth_from = 0.0, depth_to = 1.0;        ///< 0 at the lumen, 1 at the outer wall
  float hu = 40.0f;
};

/// A narrowing, as it was asked for and as the profile has it.
struct Stenosis {
  double s_from_mm = 0.0, s_to_mm = 0.0, s_throat_mm = 0.0;
  double diameter_stenosis = 0.0;  ///< 1 - (mean radius at the throat) / (healthy radius there)
  double area_stenosis = 0.0;
  double eccentricity = 0.0;  ///< 0 concentric, 1 all on one side
  PlaqueKind kind = PlaqueKind::soft;
};

/// A tube of metal just inside the lumen's boundary; its thickness stands for that of the struts, its CT
/// number for metal thinned by the gaps between them. With `struts`, rings of zigzags joined by links, solid,
/// with the lumen between them.
struct Stent {
  double s_from_mm = 0.0, s_to_mm = 0.0;
  double thickness_mm = 0.1;
  float hu = 3000.0f;
  bool struts = false;
};

/// A stretch that is closed, or all but: what lies behind it is filled from elsewhere, and poorly.
struct Occlusion {
  double s_from_mm = 0.0, s_to_mm = 0.0;
  double filling = 1.0;  ///< share of the contrast above blood that vessel and branches have behind it
};

/// A stretch of a vessel that bears one of the AHA's segment numbers (Austen et al. 1975; SCCT 2009 for 17).
struct SegmentSpan {
  int aha = 0;
  std::string name;  ///< "proximal LAD"
  double s_from_mm = 0.0, s_to_mm = 0.0;
};

/// A vessel from its origin to its distal end. Vessel 0 and every vessel with parent -1 begin at an ostium;
/// the others begin on their parent's axis and leave its lumen at `s_free_mm`.
struct CoronaryVessel {
  std::int32_t id = 0;
  std::string name;  ///< "RCA", "LAD", "LCX", "D1", "D2", "OM1", "OM2", "RI", "PDA", "AM", "CB", "S1"; "LAD"
                     ///< begins with the left main, "RCA" goes on to the posterolateral branch
  std::int32_t parent = -1;
  double parent_s_mm = 0.0;
  double s_free_mm = 0.0;
  geometry::Centerline axis;              ///< 0.1 mm steps; `radius` is the lumen's mean radius
  RadialProfile lumen, wall;              ///< wall: the outer boundary, everywhere outside the lumen
  std::vector<double> healthy_radius_mm;  ///< one an axis point: the mean radius before any lesion
  std::vector<SegmentSpan> segments;
  std::vector<Plaque> plaques;
  std::vector<Stenosis> stenoses;
  std::vector<Stent> stents;
  std::vector<Occlusion> occlusions;
};

struct CoronaryTree {
  Dominance dominance = Dominance::right;
  std::vector<CoronaryVessel> vessels;  ///< parents before children
};

struct CoronaryOptions {
  std::uint64_t seed = 1;
  double disease = 1.0;  ///< scales the number of lesions; 0 is a healthy tree
  Anatomy anatomy = Anatomy::usual;
  double calibre = 1.0;  ///< scales all radii, in [0.5, 1.3]
};
CoronaryTree draw_coronaries(const HeartShape& heart, const CoronaryOptions& options = {});

/// A narrowing to be put into a vessel, with its plaque.
struct LesionOptions {
  double s_throat_mm = 0.0;        ///< where it is narrowest
  double length_mm = 12.0;         ///< shoulder to shoulder, in [2, 40]
  double diameter_stenosis = 0.5;  ///< of the mean diameter, in [0, 0.95]
  double eccentricity = 0.3;       ///< in [0, 1): 1 - (narrowing opposite the plaque) / (mean narrowing)
  double theta = 0.0;              ///< side of the plaque, rad
  double remodelling = 1.1;        ///< outer wall's radius at the throat over the healthy one, in [1, 1.5]
  PlaqueKind kind = PlaqueKind::mixed;
  double plateau = 0.15;   ///< share of the length that is as narrow as the throat, in [0, 0.9]
  std::uint64_t seed = 1;  ///< of the plaque's nodules and CT numbers
};
/// Narrows the lumen, moves the outer wall and records stenosis and plaques; the recorded grades are measured
/// in the profile. Throws InvalidInput for options out of range or a lesion that reaches beyond the vessel.
void add_lesion(CoronaryVessel& vessel, const LesionOptions& options);

/// Calcium beside that of the lesions. `amount` 0 takes all calcium away (it becomes fibrous), 1 leaves it as
/// it is, more adds nodules in both halves of the wall along the first two thirds of LAD, LCX and RCA:
/// (amount - 1) every 12 mm. Throws InvalidInput outside [0, 20].
void set_calcium(CoronaryTree& tree, double amount, std::uint64_t seed);
/// A stent of `length_mm` in a vessel, from `s_from_mm` on, even or of struts. Throws InvalidInput where it
/// reaches beyond the vessel.
void add_stent(CoronaryVessel& vessel, double s_from_mm, double length_mm, bool struts = false);

/// The tree as axes alone: nodes, segments (radius: the mean one) and vessels from each ostium to each end.
geometry::VesselTree vessel_tree(const CoronaryTree& tree);

}  // namespace ostia::phantom
