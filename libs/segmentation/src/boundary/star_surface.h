#pragma once
/// \file The optimal closed surface r(s, theta) on a grid of radii: Li, Wu, Chen and Sonka 2006.

#include "boundary/lumen_level.h"
#include "boundary/ray_fan.h"

#include <vector>

namespace ostia::segmentation {

/// Radii first + k step, k = 0 ... count - 1.
struct RadiusGrid {
  double first_mm = 0.2, step_mm = 0.1;
  int count = 0;
  double at(int k) const { return first_mm + k * step_mm; }
};

struct StarLimits {
  double along = 1.0;   ///< |dr/ds|
  double around = 1.0;  ///< |dr/dtheta| / r
};

/// cost[(row * around + a) * grid.count + k] of the surface's passing there. Least sum of costs plus
/// `variation` times the sum of all |r - r'| between neighbours, among all surfaces within the limits (at
/// least one grid step apart is always allowed). Returns the index for every ray. Throws Cancelled.
std::vector<int> least_cost_surface(const std::vector<float>& cost, int rows, int around,
                                    const RadiusGrid& grid, double row_step_mm, const StarLimits& limits,
                                    double variation, const core::TaskContext& task);

struct TissueLevels {
  double outside_hu = 50.0;  ///< of vessel wall and muscle
  double calcium_hu = 0.0;   ///< brighter is calcium
};
/// Where calcium begins on each ray, as an index of its samples: at the dip before it, or, where it touches
/// the lumen, half-way up to it. `fan.count` where there is none.
std::vector<int> calcium_onsets(const RayFan& fan, const LumenLevel& level, const TissueLevels& tissue);
/// Cost of a boundary from what is inside it: every stretch of a ray that looks like lumen is gained, every
/// one that does not, or that lies behind the onset of calcium, is lost.
std::vector<float> region_cost(const RayFan& fan, const LumenLevel& level, const TissueLevels& tissue,
                               const std::vector<int>& calcium_onset, const RadiusGrid& grid,
                               double row_step_mm);

}  // namespace ostia::segmentation
