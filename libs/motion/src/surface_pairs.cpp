#include "surface_pairs.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr std::size_t grain = 256;
constexpr double least_scale_mm = 0.1;  // distances below are never far
constexpr double tukey = 4.685;         // 95 % efficient for normal errors (Huber, Robust Statistics)

Vec3 triangle_normal(const TriMesh& mesh, const geometry::Triangle& t) {
  const auto p = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
  return (p(1) - p(0)).cross(p(2) - p(0));
}

Vec3 place_at(const TriMesh& mesh, const geometry::SurfacePoint& at) {
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 0; i < 3; ++i)
    place += at.barycentric[static_cast<Eigen::Index>(i)] *
             mesh.points[static_cast<std::size_t>(mesh.triangles[static_cast<std::size_t>(at.triangle)][i])];
  return place;
}

/// Tukey's weights by the median distance of the pairs in [first, last).
void weigh(std::vector<SurfacePair>& pairs, std::size_t first, std::size_t last, double looseness) {
  std::vector<double> distances;
  for (std::size_t i = first; i < last; ++i)
    if (pairs[i].weight > 0.0) distances.push_back(pairs[i].distance);
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const double far = looseness * tukey * std::max(least_scale_mm, 1.4826 * *middle);
  for (std::size_t i = first; i < last; ++i) {
    const double share = pairs[i].distance / far;
    pairs[i].weight *= share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
  }
}

}  // namespace

std::vector<Vec3> unit_triangle_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.triangles.size());
  for (std::size_t t = 0; t < normals.size(); ++t)
    normals[t] = triangle_normal(mesh, mesh.triangles[t]).stableNormalized();
  return normals;
}

std::vector<Vec3> unit_point_normals(const TriMesh& mesh) {
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t p : t) normals[static_cast<std::size_t>(p)] += triangle_normal(mesh, t);
  for (Vec3& n : normals) n.stableNormalize();
  return normals;
}

std::vector<double> point_areas(const TriMesh& mesh) {
  std::vector<double> areas(mesh.points.size(), 0.0);
  for (const geometry::Triangle& t : mesh.triangles)
    for (const std::int32_t p : t)
      areas[static_cast<std::size_t>(p)] += triangle_normal(mesh, t).norm() / 6.0;
  return areas;
}

PairingTarget::PairingTarget(const TriMesh& target)
    : mesh(target),
      tree(target),
      triangle_normals(unit_triangle_normals(target)),
      point_normals(unit_point_normals(target)),
      point_areas(motion::point_areas(target)) {}

std::vector<SurfacePair> surface_pairs(const TriMesh& carried, const TriMesh& at_rest,
                                       const geometry::CageGrid& grid, const PairingTarget& target,
                                       double max_angle_deg, double looseness) {
  const double least_cosine = std::cos(max_angle_deg * std::numbers::pi / 180.0);
  const std::size_t own = carried.points.size(), other = target.mesh.points.size();
  const geometry::AabbTree source_tree(carried);
  const std::vector<Vec3> triangle_normals = unit_triangle_normals(carried);
  const std::vector<Vec3> normals = unit_point_normals(carried);
  const std::vector<double> areas = point_areas(carried);
  std::vector<SurfacePair> pairs(own + other);
  core::parallel_for(own, grain, [&](std::size_t i) {
    const geometry::SurfacePoint at = target.tree.closest(carried.points[i]);
    const Vec3& normal = target.triangle_normals[static_cast<std::size_t>(at.triangle)];
    if (normal.dot(normals[i]) < least_cosine) return;
    pairs[i] = {cage_point(grid, at_rest.points[i]), at.point, normal, at.distance, areas[i]};
  });
  core::parallel_for(other, grain, [&](std::size_t i) {
    const geometry::SurfacePoint at = source_tree.closest(target.mesh.points[i]);
    const Vec3& normal = target.point_normals[i];
    if (normal.dot(triangle_normals[static_cast<std::size_t>(at.triangle)]) < least_cosine) return;
    pairs[own + i] = {cage_point(grid, place_at(at_rest, at)), target.mesh.points[i], normal, at.distance,
                      target.point_areas[i]};
  });
  weigh(pairs, 0, own, looseness);
  weigh(pairs, own, own + other, looseness);
  return pairs;
}

}  // namespace ostia::motion
