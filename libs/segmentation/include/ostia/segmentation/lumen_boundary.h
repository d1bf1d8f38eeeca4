#pragma once
/// \file The lumen's boundary on rays across a given axis.

#include "ostia/core/task_context.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/imaging/volume.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::segmentation {

/// docs/methods/lumen-boundary.md gives the method and the sources of the defaults.
struct LumenBoundaryOptions {
  double step_mm = 0.5;            ///< along the axis, [0.1, 2]
  int around = 32;                 ///< rays of a ring, [8, 128]
  double radial_step_mm = 0.1;     ///< of the grid of candidate radii, [0.02, 0.5]
  double largest_radius_mm = 4.0;  ///< [0.5, 20]
  double blur_sigma_mm = 0.3;  ///< the scanner's point spread (standard deviation), [0, 1.5]; 0: as if sharp
  /// Usual CT number of the vessel's wall, which the scan does not resolve, [-100, 200].
  double wall_hu = 50.0;
  double calcium_hu = 0.0;  ///< 0: from the lumen's own statistics; brighter than this is calcium, not lumen
  double largest_slope_along = 1.0;   ///< limit of |dr/ds|, [0.05, 10]
  double largest_slope_around = 1.0;  ///< limit of |dr/dtheta| / the smaller r of two neighbours, [0.05, 10]
};
void validate(const LumenBoundaryOptions& options);

/// r(s, theta) on a grid: rows at s = from + i step, angles from theta = 0 (geometry::radial_direction).
struct LumenBoundary {
  double from_mm = 0.0, step_mm = 0.0;
  int around = 0;
  std::vector<double> radius_mm;  ///< row by row
  std::vector<float> confidence;  ///< [0, 1] for each: how clear the edge is
  /// The lumen's middle (centroid) in the plane of each row, mm; also where the axis lies outside of it.
  std::vector<geometry::Vec3> middle;
  double lumen_hu = 0.0, lumen_sigma_hu = 0.0;
  std::vector<std::string> warnings;
  int rows() const { return around > 0 ? static_cast<int>(radius_mm.size()) / around : 0; }
  double at(double s_mm, double theta) const;  ///< C1 between, the end row's beyond the ends
};

/// Optimal closed surface about the axis between two abscissas: least cost over all surfaces within the slope
/// limits (graph cut), then placed between grid radii by a model of the blurred edge. Throws InvalidInput
/// (axis outside the image, from >= to, more than 10^7 candidates), Cancelled.
LumenBoundary lumen_boundary(const imaging::ImageVolume& image, const geometry::AxisCurve& axis,
                             double from_mm, double to_mm, const LumenBoundaryOptions& options = {},
                             const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
