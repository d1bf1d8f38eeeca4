#pragma once
/// \file A first outer wall on a grid of radii: where rays meet fat.

#include "boundary/ray_fan.h"
#include "outer_wall/profile.h"

#include "ostia/core/task_context.h"
#include "ostia/segmentation/outer_wall.h"

#include <vector>

namespace ostia::segmentation {

/// The lumen as rays from its middle see it, and what lies about it.
struct WallScene {
  RayFan fan;
  std::vector<double> lumen_mm;          ///< one a ray
  std::vector<double> lumen_hu, fat_hu;  ///< one a row
  double row_step_mm = 0.5;
};

/// Typical fat about each row, beyond the wall; smooth along the vessel. `usual_hu` where there is none.
std::vector<double> fat_levels(const WallScene& scene, double usual_hu);

struct WallStart {
  std::vector<double> radius_mm;
  std::vector<char> seen;  ///< the ray leaves the wall into fat
};
/// Every stretch of a ray that is brighter than half-way between wall and fat, the lumen's blur taken away,
/// is gained, every one that is darker is lost; rays that meet no fat within reach say nothing, and the least
/// variation of the surface decides. Optimal within the slope limits (least_cost_surface). Throws Cancelled.
WallStart first_outer_wall(const WallScene& scene, const BlurredDiscs& discs, const RadiusGrid& grid,
                           const OuterWallOptions& options, const core::TaskContext& task);

}  // namespace ostia::segmentation
