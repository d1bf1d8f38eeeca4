#pragma once
/// \file The part of a CT that a picture of the heart shows: without ribs, breastbone and spine.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

/// A place on the axis of a coronary artery.
struct ArteryPlace {
  Vec3 place = Vec3::Zero();  ///< LPS, mm
  double radius_mm = 1.0;     ///< of the lumen there
};

/// docs/methods/heart-region.md says where the defaults come from. All in mm.
struct HeartRegionOptions {
  double about_tree = 10.0;  ///< all of what is so near to the tree's convex hull, in [0, 50]
  double blood = 45.0;       ///< so far from it blood that hangs together with it is followed, in [0, 150]
  double neck = 2.0;         ///< blood that hangs on by a neck thinner than twice this is not, in [0, 10]
  double about_artery =
      2.0;  ///< all of what is so near to an artery's wall, whatever it was taken for, [0, 10]
};
void validate(const HeartRegionOptions& options);  ///< throws InvalidInput that names the option

/// A mask on the image's grid, 1 what is shown: what lies within the hull of the arteries and a little about
/// it, chambers and great vessels that are filled with contrast and begin there, and each artery, calcium
/// included; bones (segmentation::tissues_to_remove) and what else is bright in the chest are out. Without
/// arteries nothing is known of where the heart is: then all but the bones is 1. For display: a voxel is
/// never measured by it. Deterministic, the same for any number of threads. Throws InvalidInput for an empty
/// image, options out of range, or places that are not finite or all outside of the image; Cancelled.
imaging::MaskVolume heart_region(const imaging::ImageVolume& image, const std::vector<ArteryPlace>& arteries,
                                 const HeartRegionOptions& options = {},
                                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
