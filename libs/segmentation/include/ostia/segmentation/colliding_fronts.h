#pragma once
/// \file Initial regions by wave fronts: colliding fronts ([Antiga] 3.2, eq. 2 and 3) and plain fast
/// marching.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/initial_region.h"
#include "ostia/segmentation/seeds.h"

#include <optional>
#include <vector>

namespace ostia::segmentation {

/// Where fronts may go.
enum class FrontDomain {
  sparse,       ///< voxels are visited as fronts reach them; a front stops when it has covered the vessel
  whole_volume  ///< fronts run until nothing is left to reach
};

struct CollidingFrontsOptions {
  /// Fronts stay within these intensities (HU); either bound may be given alone. What is left out is chosen
  /// from the image around the seeds (see `intensity_range_around`).
  std::optional<double> lower_hu = std::nullopt;
  std::optional<double> upper_hu = std::nullopt;
  FrontDomain domain = FrontDomain::sparse;
  double slowest =
      0.7;  ///< speed at the lower bound as a part of the lumen's, in (0, 1]: below 0.7 the rim is left out
  double overrun = 0.15;  ///< a front goes on until this much later than it reached the other seed, >= 0
  int margin_voxels = 6;  ///< kept free around the region on every side, >= 1
};
/// Throws InvalidInput.
void validate(const CollidingFrontsOptions& options);

/// The region between the two ends of a branch: phi0 = grad T1 . grad T2 < 0 and connected to both seeds,
/// where |grad T| = 1/F and F grows with the intensity. Values are the cosine of the angle between the two
/// gradients (same sign as eq. 3). Side branches are left out since both fronts run into them the same way.
/// With `through`, two pairs in a row whose regions overlap. Throws InvalidInput (a seed outside the image,
/// in air or outside the intensity range: it says the HU there and the range), GeometryError (the fronts
/// never meet).
InitialRegion colliding_fronts(const imaging::ImageVolume& image, const BranchSeeds& branch,
                               const CollidingFrontsOptions& options = {},
                               const core::TaskContext& task = core::no_task());

/// The front from many seeds at the time it reaches the first target: phi0 = T - t_target ([Antiga] 3.2), for
/// objects that are not tubes and for whole networks; values divided by the distance a front runs through one
/// voxel and limited to [-1, 1]. Needs a range as colliding fronts do. Throws as colliding_fronts;
/// GeometryError when no target is reached.
InitialRegion fast_marching_initialisation(const imaging::ImageVolume& image,
                                           const std::vector<Vec3>& seeds_mm,
                                           const std::vector<Vec3>& targets_mm,
                                           const CollidingFrontsOptions& options = {},
                                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
