#include "editing/drawn_curve.h"

#include <algorithm>
#include <cmath>

namespace ostia::lumen {
namespace {

// So many points are repeated at both ends of a closed curve: a cubic spline forgets its ends by a factor of
// about four a point.
constexpr std::size_t overlap = 8;

std::vector<Vec3> unrolled(const std::vector<Vec3>& points, bool closed) {
  if (!closed) return points;
  const std::size_t n = points.size();
  std::vector<Vec3> out;
  for (std::size_t i = 0; i < n + 1 + 2 * overlap; ++i)
    out.push_back(points[(i + n * overlap - overlap) % n]);
  return out;
}

// Arc length at each point the spline passes through.
std::vector<double> knots_of(const geometry::ArcLengthSpline& spline, const std::vector<Vec3>& points) {
  std::vector<double> knots{0.0};
  for (std::size_t i = 1; i < points.size(); ++i) {
    const double chord = (points[i] - points[i - 1]).norm();
    // The arc is at least the chord; the first nearest place from there on is the point.
    double best = knots.back() + chord, best_distance = (spline.point(best) - points[i]).norm();
    const double step = chord / 16.0;
    for (double s = best + step; s <= knots.back() + 4.0 * chord; s += step) {
      const double distance = (spline.point(s) - points[i]).norm();
      if (distance >= best_distance) {
        if (best_distance < 0.5 * chord) break;
        continue;
      }
      best = s;
      best_distance = distance;
    }
    for (int iteration = 0; iteration < 12; ++iteration) {
      const double move = (points[i] - spline.point(best)).dot(spline.tangent(best));
      best = std::clamp(best + move, knots.back() + 1e-3 * chord, spline.length());
      if (std::abs(move) < 1e-10) break;
    }
    knots.push_back(best);
  }
  return knots;
}

double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

bool cross_each_other(const Vec2& a, const Vec2& b, const Vec2& c, const Vec2& d) {
  const double abc = cross(b - a, c - a), abd = cross(b - a, d - a);
  const double cda = cross(d - c, a - c), cdb = cross(d - c, b - c);
  return (abc > 0.0) != (abd > 0.0) && (cda > 0.0) != (cdb > 0.0);
}

}  // namespace

DrawnCurve::DrawnCurve(const std::vector<Vec3>& points, bool closed)
    : closed_(closed), spline_(unrolled(points, closed)) {
  const std::vector<Vec3> passed = unrolled(points, closed);
  knots_ = knots_of(spline_, passed);
  if (!closed) return;
  const auto first = static_cast<std::ptrdiff_t>(overlap);
  knots_ = std::vector<double>(knots_.begin() + first,
                               knots_.begin() + first + static_cast<std::ptrdiff_t>(points.size()) + 1);
}

CurvePlace DrawnCurve::at(double abscissa_mm) const {
  const double s = knots_.front() + std::clamp(abscissa_mm, 0.0, length());
  return {spline_.point(s), spline_.tangent(s)};
}

std::vector<CurvePlace> DrawnCurve::sampled(double spacing_mm) const {
  std::vector<CurvePlace> places;
  for (std::size_t i = 0; i + 1 < knots_.size(); ++i) {
    const double whole = knots_[i + 1] - knots_[i];
    const auto pieces = static_cast<int>(std::max(1.0, std::round(whole / spacing_mm)));
    for (int k = 0; k < pieces; ++k) places.push_back(at(knots_[i] - knots_.front() + whole * k / pieces));
  }
  if (!closed_) places.push_back(at(length()));
  return places;
}

std::vector<Vec3> merged_neighbours(const std::vector<Vec3>& points, double least_mm, bool closed) {
  std::vector<Vec3> merged;
  std::vector<double> count;
  for (const Vec3& point : points) {
    if (!merged.empty() && (point - merged.back()).norm() < least_mm) {
      merged.back() = (merged.back() * count.back() + point) / (count.back() + 1.0);
      count.back() += 1.0;
    } else {
      merged.push_back(point);
      count.push_back(1.0);
    }
  }
  if (merged.size() < 2) return merged;
  if (closed) {
    if ((merged.front() - merged.back()).norm() < least_mm) {
      merged.front() =
          (merged.front() * count.front() + merged.back() * count.back()) / (count.front() + count.back());
      merged.pop_back();
    }
  } else {
    merged.front() = points.front();
    merged.back() = points.back();
  }
  return merged;
}

std::optional<std::pair<std::size_t, std::size_t>> self_crossing(const std::vector<Vec2>& line, bool closed) {
  const std::size_t n = line.size(), pieces = closed ? n : n - (n > 0 ? 1 : 0);
  for (std::size_t i = 0; i < pieces; ++i) {
    for (std::size_t j = i + 2; j < pieces; ++j) {
      if (closed && i == 0 && j + 1 == n) continue;
      if (cross_each_other(line[i], line[(i + 1) % n], line[j], line[(j + 1) % n])) return std::pair{i, j};
    }
  }
  return std::nullopt;
}

}  // namespace ostia::lumen
