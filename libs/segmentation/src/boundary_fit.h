#pragma once
/// \file The boundary between grid radii: the rays' edge models and a smooth surface made to agree.

#include "edge_profile.h"
#include "ray_fan.h"

#include <vector>

namespace ostia::segmentation {

struct BoundaryFitOptions {
  double row_step_mm = 0.5;
  double data_weight = .2;         ///< neighbouring rays share their noise: they are no independent witnesses
  double bend_along_per_mm = .15;  ///< usual size of d2r/ds2
  double bend_around = .8;         ///< usual size of (d2r/dtheta2) / r
};

struct BoundaryFit {
  std::vector<double> radius_mm;
  std::vector<float> confidence;
};

/// Starts from `radius_mm` and stays within EdgeProfile::reach_mm() of it.
BoundaryFit fit_boundary(const RayFan& fan, const std::vector<double>& lumen_hu,
                         const std::vector<double>& radius_mm, const std::vector<float>& calcium_odds,
                         const EdgeProfile& profile, const BoundaryFitOptions& options,
                         const core::TaskContext& task);

}  // namespace ostia::segmentation
