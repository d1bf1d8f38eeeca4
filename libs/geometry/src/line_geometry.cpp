#include "ostia/geometry/line_geometry.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

constexpr double straight_per_mm = 1e-4;
constexpr double coincident_mm = 1e-12;

/// First and second derivatives at the inner points, and the lengths of both pieces together; zero elsewhere.
struct NeighbourDifferences {
  std::vector<Vec3> first, second;
  std::vector<double> span;
};

NeighbourDifferences neighbour_differences(const std::vector<Vec3>& p) {
  const std::size_t n = p.size();
  NeighbourDifferences out{std::vector<Vec3>(n, Vec3::Zero()), std::vector<Vec3>(n, Vec3::Zero()),
                           std::vector<double>(n, 0.0)};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 before = p[i] - p[i - 1], after = p[i + 1] - p[i];
    const double a = before.norm(), b = after.norm();
    if (a < coincident_mm || b < coincident_mm) continue;
    out.span[i] = a + b;
    out.first[i] = (before + after) / (a + b);
    out.second[i] = 2.0 * (after / b - before / a) / (a + b);
  }
  return out;
}

/// Where a point has none, the one before it; before the first one that one; else `fallback`.
void fill_normals(std::vector<Vec3>& normals, const std::vector<Vec3>& tangents,
                  const std::vector<Vec3>& fallback) {
  const auto known = [](const Vec3& v) { return !v.isZero(0.0); };
  const auto first = std::find_if(normals.begin(), normals.end(), known);
  if (first == normals.end()) normals = fallback;
  Vec3 last = first == normals.end() ? fallback.front() : *first;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    if (known(normals[i])) last = normals[i];
    const Vec3 across = last - last.dot(tangents[i]) * tangents[i];
    if (across.norm() > 1e-9) normals[i] = across.normalized();
  }
}

}  // namespace

LineGeometry line_geometry(const std::vector<Vec3>& points, const std::vector<Vec3>& straight_normals) {
  const std::size_t n = points.size();
  if (n < 2 || straight_normals.size() != n)
    throw InvalidInput("a line of " + std::to_string(n) + " points with " +
                       std::to_string(straight_normals.size()) +
                       " normals has no curvature; give two points at least, a normal each");
  const NeighbourDifferences d = neighbour_differences(points);
  LineGeometry out{std::vector<double>(n, 0.0), std::vector<double>(n, 0.0), std::vector<Vec3>(n),
                   std::vector<Vec3>(n, Vec3::Zero()), std::vector<Vec3>(n)};
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 turn = d.first[i].cross(d.second[i]);
    if (d.first[i].norm() < coincident_mm) continue;
    out.curvature[i] = turn.norm() / std::pow(d.first[i].norm(), 3.0);
    if (out.curvature[i] > straight_per_mm) out.normal[i] = turn.cross(d.first[i]).normalized();
    if (i < 2 || i + 2 >= n || out.curvature[i] <= straight_per_mm) continue;
    const Vec3 third = (d.second[i + 1] - d.second[i - 1]) / d.span[i];
    out.torsion[i] = turn.dot(third) / turn.squaredNorm();
  }
  for (std::size_t i = 0; i < n; ++i) {
    const std::size_t inner = std::clamp<std::size_t>(i, 1, std::max<std::size_t>(n - 2, 1));
    const bool pair = n == 2 || d.first[inner].norm() < coincident_mm;
    const std::size_t piece = std::min(i, n - 2);
    out.tangent[i] = (pair ? Vec3(points[piece + 1] - points[piece]) : d.first[inner]).normalized();
  }
  fill_normals(out.normal, out.tangent, straight_normals);
  for (std::size_t i = 0; i < n; ++i) out.binormal[i] = out.tangent[i].cross(out.normal[i]);
  return out;
}

double tortuosity(const std::vector<Vec3>& points) {
  const double apart = points.size() < 2 ? 0.0 : (points.back() - points.front()).norm();
  return apart > 0.0 ? length(points) / apart - 1.0 : 0.0;
}

}  // namespace ostia::geometry
