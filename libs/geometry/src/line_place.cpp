#include "ostia/geometry/line_place.h"

#include <algorithm>

namespace ostia::geometry {
namespace {

constexpr int halvings = 60;

/// How far a place's sphere is from holding a point, mm2; positive outside.
double outside_sphere(const Centerline& line, const LinePlace& place, const Vec3& point) {
  const double radius = value_at(line.radius, place);
  return (value_at(line.points, place) - point).squaredNorm() - radius * radius;
}

/// On one piece, between a place whose sphere holds the point and one whose does not.
LinePlace sphere_crossing(const Centerline& line, std::size_t piece, double inside, double outside,
                          const Vec3& point) {
  for (int i = 0; i < halvings; ++i) {
    const double middle = 0.5 * (inside + outside);
    (outside_sphere(line, {piece, middle}, point) > 0.0 ? outside : inside) = middle;
  }
  return outside >= 1.0 ? LinePlace{piece + 1, 0.0} : LinePlace{piece, outside};
}

}  // namespace

Vec3 direction_at(const Centerline& line, const LinePlace& place) {
  const std::size_t piece = std::min(place.piece, line.size() - 2);
  return (line.points[piece + 1] - line.points[piece]).normalized();
}

LinePlace place_on_line(const Centerline& line, double abscissa_mm) {
  const std::vector<double>& s = line.abscissa;
  if (abscissa_mm <= s.front()) return {0, 0.0};
  if (abscissa_mm >= s.back()) return {s.size() - 1, 0.0};
  const auto after = static_cast<std::size_t>(std::upper_bound(s.begin(), s.end(), abscissa_mm) - s.begin());
  return {after - 1, (abscissa_mm - s[after - 1]) / (s[after] - s[after - 1])};
}

std::optional<LinePlace> touching_place(const Centerline& line, const LinePlace& from, LineWay way) {
  const Vec3 point = value_at(line.points, from);
  const auto outside = [&](std::size_t k) { return outside_sphere(line, {k, 0.0}, point) > 0.0; };
  if (way == LineWay::upstream) {
    for (std::size_t k = from.t > 0.0 ? from.piece + 1 : from.piece; k-- > 0;) {
      if (outside(k))
        return sphere_crossing(line, k, from.t > 0.0 && k == from.piece ? from.t : 1.0, 0.0, point);
    }
    return std::nullopt;
  }
  for (std::size_t k = from.piece + 1; k < line.size(); ++k) {
    if (outside(k)) return sphere_crossing(line, k - 1, k - 1 == from.piece ? from.t : 0.0, 1.0, point);
  }
  return std::nullopt;
}

std::vector<LinePlace> sphere_steps(const Centerline& line, const LinePlace& from) {
  std::vector<LinePlace> steps{from};
  while (const auto next = touching_place(line, steps.back(), LineWay::downstream)) {
    if (!(steps.back() < *next)) break;  // a sphere without width
    steps.push_back(*next);
  }
  return steps;
}

}  // namespace ostia::geometry
