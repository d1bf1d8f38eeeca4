#include "ostia/geometry/contour_set.h"

#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

Vec3 newell(const Contour& contour) {
  Vec3 sum = Vec3::Zero();
  const std::size_t n = contour.points.size();
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 a = contour.points[i] - contour.points[0], b = contour.points[(i + 1) % n] - contour.points[0];
    sum += a.cross(b);
  }
  return 0.5 * sum;
}

using Vec2d = Eigen::Vector2d;

double turn(const Vec2d& a, const Vec2d& b, const Vec2d& c) {
  return (b - a).x() * (c - a).y() - (b - a).y() * (c - a).x();
}

bool within(const Vec2d& a, const Vec2d& b, const Vec2d& p) {
  return p.x() >= std::min(a.x(), b.x()) && p.x() <= std::max(a.x(), b.x()) &&
         p.y() >= std::min(a.y(), b.y()) && p.y() <= std::max(a.y(), b.y());
}

bool pieces_meet(const Vec2d& a, const Vec2d& b, const Vec2d& c, const Vec2d& d) {
  const double abc = turn(a, b, c), abd = turn(a, b, d), cda = turn(c, d, a), cdb = turn(c, d, b);
  if (((abc > 0) != (abd > 0)) && ((cda > 0) != (cdb > 0)) && abc != 0 && abd != 0 && cda != 0 && cdb != 0)
    return true;
  return (abc == 0 && within(a, b, c)) || (abd == 0 && within(a, b, d)) || (cda == 0 && within(c, d, a)) ||
         (cdb == 0 && within(c, d, b));
}

std::optional<std::string> fault_of(const Contour& contour) {
  const std::size_t n = contour.points.size();
  if (!std::isfinite(contour.s_mm)) return "its s_mm is not a number";
  if (n < 3) return "it has " + std::to_string(n) + " points, three are needed";
  for (std::size_t i = 0; i < n; ++i) {
    if (!contour.points[i].allFinite()) return "point " + std::to_string(i) + " is not finite";
    if ((contour.points[i] - contour.points[(i + 1) % n]).norm() <= 1e-9)
      return "points " + std::to_string(i) + " and " + std::to_string((i + 1) % n) +
             " coincide (the first point is not repeated at the end)";
  }
  if (!(contour_area(contour) > 0.0)) return "it has no area";
  if (crosses_itself(contour)) return "it crosses itself";
  return std::nullopt;
}

std::string at(const Contour& contour) {
  return "contour at s_mm " + core::significant_text(contour.s_mm, 6) + ": ";
}

}  // namespace

// A contour that runs counter-clockwise looking distally turns about minus the distal direction.
Vec3 contour_normal(const Contour& contour) {
  if (contour.points.size() < 3) return Vec3::Zero();
  const Vec3 area = newell(contour);
  const double norm = area.norm();
  return norm > 0.0 ? Vec3(-area / norm) : Vec3::Zero();
}

double contour_area(const Contour& contour) {
  return contour.points.size() < 3 ? 0.0 : newell(contour).norm();
}

Vec3 contour_centroid(const Contour& contour) {
  const std::size_t n = contour.points.size();
  if (n == 0) return Vec3::Zero();
  const Vec3 normal = -contour_normal(contour), origin = contour.points[0];
  double area = 0.0;
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 a = contour.points[i] - origin, b = contour.points[i + 1] - origin;
    const double part = 0.5 * a.cross(b).dot(normal);
    area += part;
    sum += part * (a + b) / 3.0;
  }
  if (area != 0.0) return origin + sum / area;
  for (const Vec3& p : contour.points) sum += (p - origin) / static_cast<double>(n);
  return origin + sum;
}

bool crosses_itself(const Contour& contour) {
  const std::size_t n = contour.points.size();
  const Vec3 normal = contour_normal(contour);
  if (normal.isZero()) return false;
  const Vec3 u = normal.unitOrthogonal(), v = normal.cross(u);
  std::vector<Vec2d> flat;
  for (const Vec3& p : contour.points)
    flat.emplace_back((p - contour.points[0]).dot(u), (p - contour.points[0]).dot(v));
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = i + 2; j < n; ++j) {
      if (i == 0 && j == n - 1) continue;  // neighbours
      if (pieces_meet(flat[i], flat[i + 1], flat[j], flat[(j + 1) % n])) return true;
    }
  }
  return false;
}

std::optional<std::string> find_fault(const ContourSection& section) {
  if (section.contours.size() < 2)
    return "it has " + std::to_string(section.contours.size()) + " contours, two are needed";
  for (std::size_t i = 0; i < section.contours.size(); ++i) {
    const Contour& contour = section.contours[i];
    if (const auto fault = fault_of(contour)) return at(contour) + *fault;
    if (i == 0) continue;
    const Contour& previous = section.contours[i - 1];
    if (!(contour.s_mm > previous.s_mm)) return at(contour) + "its s_mm does not ascend";
    if (contour_normal(contour).dot(contour_normal(previous)) <= 0.0)
      return at(contour) + "it runs against the contour before it";
  }
  return std::nullopt;
}

}  // namespace ostia::geometry
