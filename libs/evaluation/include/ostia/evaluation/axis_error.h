#pragma once
/// \file How far a centerline is from the true axis, and its radius from the true one.

#include "ostia/geometry/centerline.h"

#include <functional>
#include <vector>

namespace ostia::evaluation {

/// One point of a centerline against the truth.
struct AxisDeviation {
  double abscissa_mm = 0.0;  ///< on the result
  double reference_abscissa_mm = 0.0;
  double distance_mm = 0.0;  ///< to the nearest point of the reference's polyline
  double radius_mm = 0.0, reference_radius_mm = 0.0;
};

/// For each point of `result` that `counts` (all when empty; given the deviation), the nearest point of
/// `reference`.
std::vector<AxisDeviation> compare_axes(const geometry::Centerline& reference,
                                        const geometry::Centerline& result,
                                        const std::function<bool(const AxisDeviation&)>& counts = {});

struct AxisSummary {
  std::size_t points = 0;
  double mean_mm = 0.0, max_mm = 0.0;
  double radius_median_relative = 0.0;  ///< median of |r - r_ref| / r_ref
  double radius_max_relative = 0.0;
};
/// Throws InvalidInput for no points.
AxisSummary summarize(const std::vector<AxisDeviation>& deviations);

}  // namespace ostia::evaluation
