#include "mask_kinks.h"

#include "ostia/geometry/axis_curve.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <vector>

namespace ostia::coronary {
namespace {

using centerline::Axis;
using geometry::Vec3;

// Walls refuse 60 degrees, and half a radius.
constexpr double most_turn_rad = 50.0 * std::numbers::pi / 180.0;
constexpr double loop_share = 0.6;
constexpr double sample_mm = 0.2;
constexpr double eased_radii = 2.0;  // to either side of a kink
constexpr int most_rounds = 60;
// An end turns back: its chord is shorter than that of half a circle (0.64).
constexpr double hooked_share = 0.6;
constexpr double hook_from_radii = 1.5, hook_reach_radii = 4.0, least_hook_reach_mm = 3.0;
constexpr std::size_t least_points = 4;  // that an axis keeps

geometry::AxisCurve curve_of(const Axis& axis) {
  geometry::Centerline line;
  line.points = axis.points;
  line.radius = axis.radius;
  geometry::complete(line);
  return geometry::AxisCurve(line);
}

std::vector<double> kinks_of(const geometry::AxisCurve& axis) {
  std::vector<double> kinks;
  for (double s = 0.0; s <= axis.length(); s += sample_mm) {
    const double half = axis.radius(s) / 3.0;
    const Vec3 before = axis.frame(std::max(0.0, s - half)).tangent,
               behind = axis.frame(std::min(axis.length(), s + half)).tangent;
    if (before.dot(behind) < std::cos(most_turn_rad)) kinks.push_back(s);
  }
  return kinks;
}

/// A stretch that comes back to where it began goes.
bool without_a_loop(Axis& axis) {
  const std::vector<double> s = geometry::abscissas(axis.points);
  for (std::size_t i = 0; i < s.size(); ++i)
    for (std::size_t j = s.size() - 1; j > i && s[j] - s[i] > 2.0 * axis.radius[i]; --j) {
      const double least = loop_share * std::min(axis.radius[i], axis.radius[j]);
      if ((axis.points[j] - axis.points[i]).norm() >= least || j + 1 == s.size()) continue;
      const auto from = static_cast<std::ptrdiff_t>(i) + 1, to = static_cast<std::ptrdiff_t>(j) + 1;
      axis.points.erase(axis.points.begin() + from, axis.points.begin() + to);
      axis.radius.erase(axis.radius.begin() + from, axis.radius.begin() + to);
      return true;
    }
  return false;
}

}  // namespace

bool trim_hooked_end(Axis& axis) {
  const std::vector<double> s = geometry::abscissas(axis.points);
  const std::size_t count = s.size();
  std::size_t hooked = count;
  for (std::size_t i = count; i-- > 0;) {
    const double way = s.back() - s[i];
    if (way > std::max(least_hook_reach_mm, hook_reach_radii * axis.radius[i])) break;
    if (way < hook_from_radii * axis.radius[i]) continue;
    if ((axis.points.back() - axis.points[i]).norm() < hooked_share * way) hooked = i;
  }
  if (hooked == count) return false;
  const Vec3 from = axis.points[hooked];
  const auto farthest = std::max_element(
      axis.points.begin() + static_cast<std::ptrdiff_t>(hooked), axis.points.end(),
      [&](const Vec3& a, const Vec3& b) { return (a - from).squaredNorm() < (b - from).squaredNorm(); });
  const auto kept = static_cast<std::size_t>(farthest - axis.points.begin()) + 1;
  if (kept < least_points || kept == count) return false;
  axis.points.resize(kept);
  axis.radius.resize(kept);
  return true;
}

void ease_kinks(Axis& axis) {
  while (axis.points.size() > 4 && without_a_loop(axis)) {
  }
  for (int round = 0; round < most_rounds && axis.points.size() > 3; ++round) {
    const geometry::AxisCurve curve = curve_of(axis);
    const std::vector<double> kinks = kinks_of(curve);
    if (kinks.empty()) return;
    const std::vector<double> s = geometry::abscissas(axis.points);
    const double share = curve.length() / s.back();
    const std::vector<Vec3> before = axis.points;
    for (std::size_t i = 1; i + 1 < s.size(); ++i) {
      const bool near = std::any_of(kinks.begin(), kinks.end(), [&](double kink) {
        return std::abs(share * s[i] - kink) < eased_radii * curve.radius(kink);
      });
      if (near) axis.points[i] = 0.5 * before[i] + 0.25 * (before[i - 1] + before[i + 1]);
    }
  }
}

}  // namespace ostia::coronary
