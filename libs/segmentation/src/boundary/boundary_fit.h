#pragma once
/// \file The boundary between grid radii: the rays' edge models and a smooth surface made to agree.

#include "boundary/edge_profile.h"
#include "boundary/ray_fan.h"
#include "boundary/star_surface.h"

#include <vector>

namespace ostia::segmentation {

struct BoundaryFitOptions {
  double row_step_mm = 0.5;
  double data_weight = 0.2;  ///< neighbouring rays share their noise: they are no independent witnesses
  double bend_along_per_mm = 0.15;  ///< usual size of d2r/ds2
  double bend_reach_mm = 1.0;       ///< bends of `radius_mm` as near as that say where it is larger
  double bend_around = 0.8;         ///< usual size of (d2r/dtheta2) / r
};

struct BoundaryFit {
  std::vector<double> radius_mm;
  std::vector<float> confidence;
};

/// Starts from `radius_mm`; the rays' own edges are looked for within EdgeProfile::reach_mm() of it, for
/// which the profile is prepared.
BoundaryFit fit_boundary(const RayFan& fan, const std::vector<double>& lumen_hu,
                         const std::vector<double>& radius_mm, const std::vector<float>& calcium_odds,
                         EdgeProfile& profile, const BoundaryFitOptions& options,
                         const core::TaskContext& task);

/// How bad each of a ray's candidate radii is: number `first` of a grid of radii and those behind it.
struct RayEnergy {
  int first = 0;
  std::vector<double> value;
};
/// The same for energies that are known, one a ray, row by row.
BoundaryFit fit_boundary(const std::vector<RayEnergy>& energy, const RadiusGrid& grid, int rows, int around,
                         const std::vector<double>& radius_mm, const BoundaryFitOptions& options,
                         const core::TaskContext& task);

}  // namespace ostia::segmentation
