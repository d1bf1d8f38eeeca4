#pragma once
/// \file A vessel as it is read from the aorta: through its parents, over its own ostium, to its end
/// (docs/methods/branches.md).

#include "ostia/analysis/stenosis.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

/// A stretch of a vessel's way whose wall is one vessel's. Abscissas are those of the way and, as both agree
/// on what they share, of the owner, too.
struct WayStretch {
  std::int32_t vessel = 0;  ///< the owner
  double from_mm = 0.0, to_mm = 0.0;
};
/// From the aorta to the vessel's end without a gap, the vessel's own part last. Throws InvalidInput for a
/// vessel that is not there.
std::vector<WayStretch> ostial_way(const lumen::LumenModel& model, std::int32_t vessel);

/// Where a vessel leaves its parent. Between the two abscissas its axis is within the parent's lumen: its own
/// wall there is a form that no image shows, and says nothing of its calibre.
struct Ostium {
  std::int32_t parent = -1;  ///< none for a vessel that begins at a root
  double joint_mm = 0.0;     ///< where the axes part: lumen::own_from_mm
  double ostium_mm = 0.0;    ///< where its axis leaves the parent's lumen, >= joint_mm
};
/// Both are the joint's where the axis does not leave the parent's lumen within three of its radii.
/// `surface_of` is asked from the calling thread. Throws InvalidInput.
Ostium ostium_of(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of, std::int32_t vessel);

/// Of every vessel on its way that leaves another one, from the aorta on, the vessel's own last; none for a
/// vessel that begins at a root. As ostium_of.
std::vector<Ostium> ostia_of(const lumen::LumenModel& model, const SurfaceOfVessel& surface_of,
                             std::int32_t vessel);

/// The options for a vessel's reference line, with every joint and ostium on its way.
ReferenceOptions reading_from_ostium(const std::vector<Ostium>& ostia, ReferenceOptions options = {});

/// The profile without a jump at any joint: diameters and areas between joint and ostium lead from the
/// parent's to the next vessel's own, as the lumen's border does. For curves; volumes and lesions are of the
/// profile itself. The same where there is no joint, or nothing measured on either side.
LumenProfile read_through(const LumenProfile& profile, const ReferenceLine& reference);

}  // namespace ostia::analysis
