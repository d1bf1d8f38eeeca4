#include "ostia/evaluation/axis_error.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>

namespace ostia::evaluation {

using geometry::Centerline;

std::vector<AxisDeviation> compare_axes(const Centerline& reference, const Centerline& result,
                                        const std::function<bool(const AxisDeviation&)>& counts) {
  if (reference.size() < 2) throw InvalidInput("the reference axis has fewer than two points");
  std::vector<AxisDeviation> out;
  for (std::size_t i = 0; i < result.size(); ++i) {
    const geometry::PolylineLocation at = geometry::closest(reference.points, result.points[i]);
    AxisDeviation deviation;
    deviation.abscissa_mm = result.abscissa[i];
    deviation.reference_abscissa_mm = at.abscissa;
    deviation.distance_mm = (at.point - result.points[i]).norm();
    deviation.radius_mm = result.radius[i];
    deviation.reference_radius_mm =
        reference.radius[at.segment] * (1.0 - at.t) + reference.radius[at.segment + 1] * at.t;
    if (!counts || counts(deviation)) out.push_back(deviation);
  }
  return out;
}

AxisSummary summarize(const std::vector<AxisDeviation>& deviations) {
  if (deviations.empty()) throw InvalidInput("no point of the axis counts");
  AxisSummary out;
  out.points = deviations.size();
  std::vector<double> relative;
  for (const AxisDeviation& d : deviations) {
    out.mean_mm += d.distance_mm / static_cast<double>(deviations.size());
    out.max_mm = std::max(out.max_mm, d.distance_mm);
    relative.push_back(std::abs(d.radius_mm - d.reference_radius_mm) / d.reference_radius_mm);
  }
  std::sort(relative.begin(), relative.end());
  const std::size_t half = relative.size() / 2;
  out.radius_median_relative =
      relative.size() % 2 == 1 ? relative[half] : 0.5 * (relative[half - 1] + relative[half]);
  out.radius_max_relative = relative.back();
  return out;
}

}  // namespace ostia::evaluation
