#include "walls/contour_measures.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

// A side is bent by no more than this angle at either end: what is sharper is a corner, not an arc.
constexpr double largest_sine = 0.7;
// Widths are taken of a line with at least so many points.
constexpr std::size_t fine_points = 256;

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Of the circle through three points; positive where they turn left.
double curvature(const Vec2& before, const Vec2& here, const Vec2& after) {
  const double sides = (here - before).norm() * (after - here).norm() * (after - before).norm();
  return sides > 0.0 ? 2.0 * cross(here - before, after - here) / sides : 0.0;
}

/// The mean curvature of each side, from a point to the next.
std::vector<double> side_curvatures(const std::vector<Vec2>& line) {
  const std::size_t n = line.size();
  std::vector<double> at(n), of_side(n);
  for (std::size_t i = 0; i < n; ++i) at[i] = curvature(line[(i + n - 1) % n], line[i], line[(i + 1) % n]);
  for (std::size_t i = 0; i < n; ++i) {
    const double limit = 2.0 * largest_sine / std::max((line[(i + 1) % n] - line[i]).norm(), 1e-12);
    of_side[i] = std::clamp(0.5 * (at[i] + at[(i + 1) % n]), -limit, limit);
  }
  return of_side;
}

/// What an arc has beside its chord.
struct ArcSegment {
  double length = 0.0, area = 0.0, sagitta = 0.0;
};
ArcSegment arc_segment(double chord, double kappa) {
  const double sine = 0.5 * chord * std::abs(kappa), sign = kappa < 0.0 ? -1.0 : 1.0;
  if (sine < 1e-4) {  // series, where the formulas cancel
    return {chord * (1.0 + sine * sine / 6.0), kappa * chord * chord * chord / 12.0,
            kappa * chord * chord / 8.0};
  }
  const double half = std::asin(sine), radius = 0.5 * chord / sine;
  return {2.0 * radius * half, sign * radius * radius * (half - sine * std::cos(half)),
          sign * radius * (1.0 - std::cos(half))};
}

std::vector<Vec2> refined(const std::vector<Vec2>& line, const std::vector<double>& kappa) {
  const std::size_t n = line.size(), parts = (fine_points + n - 1) / n;
  if (parts == 1) return line;
  std::vector<Vec2> fine;
  fine.reserve(n * parts);
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 along = line[(i + 1) % n] - line[i];
    const double chord = along.norm();
    if (!(chord > 0.0)) continue;
    const Vec2 outward(along.y() / chord, -along.x() / chord);
    const double sagitta = arc_segment(chord, kappa[i]).sagitta;
    for (std::size_t k = 0; k < parts; ++k) {
      const double t = static_cast<double>(k) / static_cast<double>(parts);
      fine.push_back(line[i] + t * along + 4.0 * t * (1.0 - t) * sagitta * outward);
    }
  }
  return fine;
}

/// Rotating callipers (Shamos 1978): each side of the hull with the corner farthest from it gives a width;
/// all pairs of corners that can be farthest apart are met on the way.
void set_widths(const std::vector<Vec2>& hull, ContourMeasures& measures) {
  const std::size_t n = hull.size();
  if (n < 3) return;
  double least = INFINITY, largest = 0.0;
  std::size_t far = 1;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 &a = hull[i], &b = hull[(i + 1) % n];
    const auto height = [&](std::size_t k) { return cross(b - a, hull[k % n] - a); };
    while (height(far + 1) > height(far)) ++far;
    least = std::min(least, height(far) / (b - a).norm());
    for (const std::size_t k : {far, far + 1})
      largest = std::max({largest, (hull[k % n] - a).norm(), (hull[k % n] - b).norm()});
  }
  measures.least_width_mm = least;
  measures.largest_width_mm = largest;
}

}  // namespace

std::vector<Vec2> convex_hull(std::vector<Vec2> points) {
  const auto before = [](const Vec2& a, const Vec2& b) {
    return a.x() < b.x() || (a.x() == b.x() && a.y() < b.y());
  };
  std::sort(points.begin(), points.end(), before);
  points.erase(std::unique(points.begin(), points.end()), points.end());
  if (points.size() < 3) return points;
  std::vector<Vec2> hull;
  const auto add = [&](const Vec2& p, std::size_t least) {
    while (hull.size() >= least + 2 &&
           cross(hull.back() - hull[hull.size() - 2], p - hull[hull.size() - 2]) <= 0.0)
      hull.pop_back();
    hull.push_back(p);
  };
  for (const Vec2& p : points) add(p, 0);
  const std::size_t lower = hull.size() - 1;
  for (std::size_t i = points.size() - 1; i-- > 0;) add(points[i], lower);
  hull.pop_back();
  return hull;
}

ContourMeasures measures_of(const std::vector<Vec2>& line) {
  ContourMeasures measures;
  const std::size_t n = line.size();
  if (n < 3) return measures;
  const std::vector<double> kappa = side_curvatures(line);
  const Vec2 origin = line.front();
  Vec2 moment = Vec2::Zero();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec2 a = line[i] - origin, b = line[(i + 1) % n] - origin;
    const double chord = (b - a).norm(), triangle = 0.5 * cross(a, b);
    if (!(chord > 0.0)) continue;
    const ArcSegment arc = arc_segment(chord, kappa[i]);
    const Vec2 outward((b - a).y() / chord, -(b - a).x() / chord);
    measures.area_mm2 += triangle + arc.area;
    measures.perimeter_mm += arc.length;
    moment += triangle * (a + b) / 3.0 + arc.area * (0.5 * (a + b) + 0.4 * arc.sagitta * outward);
  }
  if (measures.area_mm2 > 0.0) measures.centroid = origin + moment / measures.area_mm2;
  set_widths(convex_hull(refined(line, kappa)), measures);
  return measures;
}

}  // namespace ostia::analysis
