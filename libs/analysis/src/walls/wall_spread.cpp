#include "ostia/analysis/wall_spread.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::analysis {
namespace {

constexpr double least_radius_mm = 0.2;  // of a lumen that a scan can show

/// Of the values of `figure` that are above 0 within reach of a section: the one below which `share` lie.
double figure_about(const std::vector<WallEvidence>& evidence, std::size_t at, double reach_mm,
                    double WallEvidence::*figure, double share) {
  std::vector<double> values;
  for (const WallEvidence& one : evidence)
    if (one.in_image && one.*figure > 0.0 && std::abs(one.s_mm - evidence[at].s_mm) <= reach_mm + 1e-9)
      values.push_back(one.*figure);
  if (values.empty()) return 0.0;
  const auto which =
      values.begin() + static_cast<std::ptrdiff_t>(share * static_cast<double>(values.size() - 1) + 0.5);
  std::nth_element(values.begin(), which, values.end());
  return *which;
}

/// Slope and bend of the radius along the axis, over a millimetre to either side.
struct RadiusCourse {
  double slope = 0.0, bend_per_mm = 0.0;
};
RadiusCourse course_at(const std::vector<WallEvidence>& evidence, std::size_t at) {
  constexpr double half_mm = 1.0;
  const double s = evidence[at].s_mm;
  std::size_t before = at, behind = at;
  while (before > 0 && s - evidence[before].s_mm < half_mm - 1e-6) --before;
  while (behind + 1 < evidence.size() && evidence[behind].s_mm - s < half_mm - 1e-6) ++behind;
  const auto radius = [&](std::size_t i) { return 0.5 * evidence[i].calibre_mm; };
  const double a = s - evidence[before].s_mm, b = evidence[behind].s_mm - s;
  if (!(a > 0.0 && b > 0.0) || !(radius(before) > 0.0 && radius(behind) > 0.0)) return {};
  const double first = (radius(at) - radius(before)) / a, second = (radius(behind) - radius(at)) / b;
  return {(a * first + b * second) / (a + b), 2.0 * (second - first) / (a + b)};
}

double seen_square(const WallSpreadModel& model, double ray_mm, double blur, double radius,
                   const RadiusCourse& course) {
  const double noise = model.noise * ray_mm * std::sqrt(blur / radius);
  const double size = model.size * blur * blur / radius;
  const double slope = model.slope * blur * course.slope;
  const double bend = model.bend * blur * blur * course.bend_per_mm;
  return model.scale * model.scale * (noise * noise + size * size + slope * slope + bend * bend);
}

}  // namespace

void validate(const WallSpreadModel& model) {
  const auto require = [](double value, double low, double high, const char* what) {
    if (!(value >= low && value <= high)) throw InvalidInput(std::string("spread of a wall: ") + what);
  };
  for (const double factor : {model.scale, model.noise, model.size, model.slope, model.bend, model.unseen})
    require(factor, 0.0, 10.0, "factors have to be in [0, 10]");
  require(model.most_mm, 0.05, 1.0, "most_mm has to be in [0.05, 1] mm");
  require(model.reach_mm, 0.0, 50.0, "reach_mm has to be in [0, 50] mm");
}

std::vector<double> radius_spreads_mm(const std::vector<WallEvidence>& evidence, double noise_hu,
                                      const WallSpreadModel& model) {
  validate(model);
  std::vector<double> out;
  for (std::size_t i = 0; i < evidence.size(); ++i) {
    const WallEvidence& one = evidence[i];
    const double contrast = figure_about(evidence, i, model.reach_mm, &WallEvidence::contrast_hu, 0.75);
    const double blur = figure_about(evidence, i, model.reach_mm, &WallEvidence::blur_mm, 0.5);
    if (!one.in_image || !(one.calibre_mm > 0.0) || !(contrast > 0.0) || !(blur > 0.0)) {
      out.push_back(model.most_mm);
      continue;
    }
    const double radius = std::max(least_radius_mm, 0.5 * one.calibre_mm);
    const double ray = std::sqrt(2.0 * std::numbers::pi) * noise_hu * blur / contrast;
    const double seen = seen_square(model, ray, blur, radius, course_at(evidence, i));
    const double hidden = one.calcium_share + (1.0 - one.calcium_share) * (1.0 - one.clear_share);
    const double unseen = model.unseen * hidden * blur;
    out.push_back(std::min(model.most_mm, std::sqrt(seen + unseen * unseen)));
  }
  return out;
}

}  // namespace ostia::analysis
