#pragma once
/// \file How bright the lumen is along the vessel.

#include "boundary/ray_fan.h"

#include <vector>

namespace ostia::segmentation {

struct LumenLevel {
  std::vector<double> hu;  ///< one a row; smooth along the vessel
  double typical_hu = 0.0, sigma_hu = 0.0;
};

/// From what lies within `core_mm` of the axis, calcium and stenoses being outliers.
LumenLevel lumen_level(const RayFan& fan, double core_mm, double row_step_mm);
struct CoreOptions {
  double blur_sigma_mm = 0.3;
  double outside_hu = 50.0;  ///< of what the blur mixes into a thin lumen
};
/// From what lies inside a known boundary, away from its blur where the lumen is wide enough, corrected for
/// the blur where it is not; rows too thin for that say nothing. `first` where no row near by says anything.
LumenLevel lumen_level(const RayFan& fan, const std::vector<double>& radius_mm, const CoreOptions& core,
                       double row_step_mm, const LumenLevel& first);

double median(std::vector<double> values);  ///< 0 for none

}  // namespace ostia::segmentation
