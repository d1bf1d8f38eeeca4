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
constexpr double least_scale_mm = 0.1;                     // distances below are never far
constexpr double alien_share = 0.05, mutual_share = 0.15;  // see trust
constexpr double tukey = 4.685;  // 95 % efficient for normal errors (Huber, Robust Statistics)

double least_cosine_of(double max_angle_deg) {
  return std::cos(max_angle_deg * std::numbers::pi / 180.0);
}

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

/// How far the place that a point is paired with is from the point's own surface, as a share of their
/// distance: about 1 where both are closest to each other, small where the point belongs to a branch that the
/// other surface lacks, and the place to another one. 0 and 1 are its trust: none, all.
double trust(const Vec3& place, double distance, const geometry::AabbTree& own) {
  const double back = own.closest(place).distance;
  const double share = (back + least_scale_mm) / (distance + least_scale_mm);
  return std::clamp((share - alien_share) / (mutual_share - alien_share), 0.0, 1.0);
}

/// Tukey's weights by the median distance of the pairs in [first, last), looser where the two places are
/// closest to each other. `own` is the surface of the points, `place` what they are paired with.
template <class Place>
void weigh(std::vector<SurfacePair>& pairs, std::size_t first, std::size_t last, double looseness,
           const geometry::AabbTree& own, const Place& place) {
  std::vector<double> distances;
  for (std::size_t i = first; i < last; ++i)
    if (pairs[i].weight > 0.0) distances.push_back(pairs[i].distance);
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const double far = tukey * std::max(least_scale_mm, 1.4826 * *middle);
  core::parallel_for(last - first, grain, [&](std::size_t k) {
    SurfacePair& pair = pairs[first + k];
    if (pair.weight == 0.0) return;
    const bool asked = looseness > 1.0 && pair.distance > 0.5 * far;
    const double loose = asked ? std::pow(looseness, trust(place(first + k), pair.distance, own)) : looseness;
    const double share = pair.distance / (far * loose);
    pair.weight *= share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
  });
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
  const double least_cosine = least_cosine_of(max_angle_deg);
  const std::size_t own = carried.points.size(), other = target.mesh.points.size();
  const geometry::AabbTree source_tree(carried);
  const std::vector<Vec3> triangle_normals = unit_triangle_normals(carried);
  const std::vector<Vec3> normals = unit_point_normals(carried);
  const std::vector<double> areas = point_areas(carried);
  std::vector<SurfacePair> pairs(own + other);
  std::vector<Vec3> met(other, Vec3::Zero());  // places on the source, carried, of the target's points
  core::parallel_for(own, grain, [&](std::size_t i) {
    const geometry::SurfacePoint at = target.tree.closest(carried.points[i]);
    const Vec3& normal = target.triangle_normals[static_cast<std::size_t>(at.triangle)];
    if (normal.dot(normals[i]) < least_cosine) return;
    pairs[i] = {cage_point(grid, at_rest.points[i]), at.point, normal, at.distance, areas[i]};
  });
  core::parallel_for(other, grain, [&](std::size_t i) {
    const geometry::SurfacePoint at = source_tree.closest(target.mesh.points[i]);
    const Vec3& normal = target.point_normals[i];
    met[i] = at.point;
    if (normal.dot(triangle_normals[static_cast<std::size_t>(at.triangle)]) < least_cosine) return;
    pairs[own + i] = {cage_point(grid, place_at(at_rest, at)), target.mesh.points[i], normal, at.distance,
                      target.point_areas[i]};
  });
  weigh(pairs, 0, own, looseness, source_tree, [&](std::size_t i) { return pairs[i].target; });
  weigh(pairs, own, own + other, looseness, target.tree, [&](std::size_t i) { return met[i - own]; });
  return pairs;
}

PairingVertices::PairingVertices(const TriMesh& mesh)
    : tree(mesh.points), normals(unit_point_normals(mesh)) {}

std::vector<SurfacePair> vertex_pairs(const TriMesh& carried, const std::vector<geometry::CagePoint>& places,
                                      const PairingVertices& target, double max_angle_deg) {
  const double least_cosine = least_cosine_of(max_angle_deg);
  const std::vector<Vec3> normals = unit_point_normals(carried);
  std::vector<SurfacePair> pairs(carried.points.size());
  core::parallel_for(pairs.size(), grain, [&](std::size_t i) {
    const auto closest = static_cast<std::size_t>(target.tree.nearest(carried.points[i]));
    const Vec3 &place = target.tree.points()[closest], &normal = target.normals[closest];
    if (normal.dot(normals[i]) < least_cosine) return;
    pairs[i] = {places[i], place, normal, (place - carried.points[i]).norm(), 1.0};
  });
  return pairs;
}

}  // namespace ostia::motion
