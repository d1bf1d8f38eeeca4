#include "patient/patient_axes.h"

#include "coronaries/coronary_calibre.h"

#include "ostia/geometry/polyline.h"
#include "ostia/geometry/spline.h"

#include <algorithm>
#include <cmath>

namespace ostia::phantom {
namespace {

using geometry::ArcLengthSpline;
using geometry::Centerline;

constexpr double least_radius_mm = 0.45;
constexpr double bend_in_walls = 2.0;
constexpr double step_mm = 0.1;

/// Gaussian of a deviation along the vessel, weighted by the lengths that points stand for.
std::vector<double> evened(const std::vector<double>& s, const std::vector<double>& values,
                           double deviation) {
  std::vector<double> out(values.size());
  const auto length_at = [&](std::size_t i) {
    const double before = i == 0 ? s[i] : s[i - 1], after = i + 1 == s.size() ? s[i] : s[i + 1];
    return std::max(1e-6, 0.5 * (after - before));
  };
  for (std::size_t i = 0; i < values.size(); ++i) {
    double sum = 0.0, all = 0.0;
    for (std::size_t j = 0; j < values.size(); ++j) {
      const double d = (s[i] - s[j]) / deviation;
      if (std::abs(d) > 4.0) continue;
      const double weight = length_at(j) * std::exp(-0.5 * d * d);
      sum += weight * values[j];
      all += weight;
    }
    out[i] = sum / all;
  }
  return out;
}

/// Pools neighbours that rise until nothing does.
std::vector<double> falling(const std::vector<double>& values) {
  struct Pool {
    double sum = 0.0;
    std::size_t count = 0;
    double mean() const { return sum / static_cast<double>(count); }
  };
  std::vector<Pool> pools;
  for (const double value : values) {
    pools.push_back({value, 1});
    while (pools.size() > 1 && pools.back().mean() > pools[pools.size() - 2].mean()) {
      const Pool last = pools.back();
      pools.pop_back();
      pools.back().sum += last.sum;
      pools.back().count += last.count;
    }
  }
  std::vector<double> out;
  for (const Pool& pool : pools) out.insert(out.end(), pool.count, pool.mean());
  return out;
}

/// The least ratio of the radius of curvature to the outer wall's radius.
double least_ratio(const Centerline& axis, const std::vector<double>& abscissas,
                   const std::vector<double>& radius) {
  constexpr std::size_t reach = 8;
  double least = 1e9;
  std::size_t at = 0;
  const double scale = abscissas.back() / (step_mm * static_cast<double>(axis.size() - 1));
  for (std::size_t i = reach; i + reach < axis.size(); i += 3) {
    const Vec3 behind = axis.points[i] - axis.points[i - reach],
               ahead = axis.points[i + reach] - axis.points[i];
    const double curvature = (ahead - behind).norm() / (behind.norm() * ahead.norm());
    const double s = scale * step_mm * static_cast<double>(i);
    while (at + 1 < abscissas.size() && abscissas[at + 1] <= s) ++at;
    least = std::min(least, 1.0 / (std::max(1e-9, curvature) * healthy_wall_radius(radius[at])));
  }
  return least;
}

}  // namespace

Centerline smooth_axis(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                       const Vec3& first_normal) {
  std::vector<Vec3> clean;
  std::vector<double> radius;
  for (std::size_t i = 0; i < points.size(); ++i) {
    if (!clean.empty() && (points[i] - clean.back()).norm() < 0.05) continue;
    clean.push_back(points[i]);
    radius.push_back(radius_mm[i]);
  }
  const std::vector<double> t = geometry::abscissas(clean);
  std::vector<double> weights(t.size());
  for (std::size_t i = 0; i < t.size(); ++i)
    weights[i] = std::max(0.05, 0.5 * (t[std::min(i + 1, t.size() - 1)] - t[i == 0 ? 0 : i - 1]));
  Centerline axis;
  for (double stiffness = 4.0; stiffness < 1e5; stiffness *= 3.0) {
    const ArcLengthSpline spline(geometry::smoothing_spline(t, clean, weights, stiffness, true));
    const auto steps = static_cast<std::size_t>(std::max(8.0, std::ceil(spline.length() / step_mm)));
    axis.points.clear();
    for (std::size_t i = 0; i <= steps; ++i)
      axis.points.push_back(
          spline.point(spline.length() * static_cast<double>(i) / static_cast<double>(steps)));
    if (least_ratio(axis, t, radius) >= bend_in_walls) break;
  }
  geometry::complete(axis, first_normal);
  return axis;
}

std::vector<double> healthy_calibre(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                                    double rim_mm) {
  constexpr double first_mm = 4.0, then_mm = 2.0;
  const std::vector<double> s = geometry::abscissas(points);
  std::vector<double> radius;
  for (const double r : radius_mm) radius.push_back(std::max(least_radius_mm, r - rim_mm));
  return evened(s, falling(evened(s, radius, first_mm)), then_mm);
}

}  // namespace ostia::phantom
