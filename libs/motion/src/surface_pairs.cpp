#include "surface_pairs.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::motion {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr std::size_t pair_grain = 256;
constexpr std::size_t enough_points = 2000;                // of a surface to be paired
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

/// Where a point meets the other surface.
using Meeting = geometry::SurfacePoint;

/// How far the place that a point is paired with is from the point's own surface, as a share of their
/// distance: about 1 where both are closest to each other, small where the point belongs to a branch that the
/// other surface lacks, and the place to another one. 0 and 1 are its trust: none, all.
double trust(const Meeting& met, const geometry::MovingSurface& own) {
  const double back = own.closest(met.point).distance;
  const double share = (back + least_scale_mm) / (met.distance + least_scale_mm);
  return std::clamp((share - alien_share) / (mutual_share - alien_share), 0.0, 1.0);
}

/// One point of so many is paired.
std::size_t stride_of(const TriMesh& mesh, std::size_t every) {
  return std::clamp<std::size_t>(mesh.points.size() / enough_points, 1, std::max<std::size_t>(1, every));
}

/// Tukey's weights by the median distance of `pairs`, the first of which is that of `own`'s first point;
/// looser where the two places are closest to each other.
void weigh(SurfacePair* pairs, const std::vector<Meeting>& met, const geometry::MovingSurface& own,
           double looseness) {
  std::vector<double> distances;
  for (std::size_t i = 0; i < met.size(); ++i)
    if (pairs[i].weight > 0.0) distances.push_back(pairs[i].distance);
  if (distances.empty()) return;
  const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
  std::nth_element(distances.begin(), middle, distances.end());
  const double far = tukey * std::max(least_scale_mm, 1.4826 * *middle);
  core::parallel_for(met.size(), pair_grain, [&](std::size_t i) {
    SurfacePair& pair = pairs[i];
    if (pair.weight == 0.0) return;
    const bool asked = looseness > 1.0 && pair.distance > 0.5 * far;
    const double loose = asked ? std::pow(looseness, trust(met[i], own)) : looseness;
    const double share = pair.distance / (far * loose);
    pair.weight *= share < 1.0 ? (1.0 - share * share) * (1.0 - share * share) : 0.0;
  });
}

}  // namespace

SurfaceFrames::SurfaceFrames(const TriMesh& mesh)
    : triangle_normals(mesh.triangles.size()),
      point_normals(mesh.points.size(), Vec3::Zero()),
      point_areas(mesh.points.size(), 0.0) {
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    const Vec3 twice = triangle_normal(mesh, mesh.triangles[t]);
    const double length = twice.stableNorm();
    triangle_normals[t] = length > 0.0 ? Vec3(twice / length) : Vec3::Zero();
    for (const std::int32_t p : mesh.triangles[t]) {
      point_normals[static_cast<std::size_t>(p)] += twice;
      point_areas[static_cast<std::size_t>(p)] += length / 6.0;
    }
  }
  core::parallel_for(point_normals.size(), 1024, [&](std::size_t i) { point_normals[i].stableNormalize(); });
}

PairedSurface::PairedSurface(const TriMesh& mesh)
    : at_rest(mesh), now(mesh), tree(mesh), frames(mesh), meet(mesh.points.size(), -1) {}

void PairedSurface::move(const std::vector<Vec3>& points) {
  now.points = points;
  tree.move(points);
  frames = SurfaceFrames(now);
}

std::vector<SurfacePair> surface_pairs(PairedSurface& source, PairedSurface& target,
                                       const geometry::CageGrid& grid, const PairingRules& rules) {
  const double least_cosine = least_cosine_of(rules.max_angle_deg);
  const std::size_t own = source.now.points.size(), other = target.now.points.size();
  std::vector<SurfacePair> pairs(own + other);
  std::vector<Meeting> met(own), met_by_target(other);
  const std::size_t own_stride = stride_of(source.now, rules.every),
                    other_stride = stride_of(target.now, rules.every);
  core::parallel_for(own, pair_grain, [&](std::size_t i) {
    if (i % own_stride != 0) return;
    const Meeting at = target.tree.closest(source.now.points[i], source.meet[i]);
    source.meet[i] = at.triangle;
    met[i] = at;
    const Vec3& normal = target.frames.triangle_normals[static_cast<std::size_t>(at.triangle)];
    if (normal.dot(source.frames.point_normals[i]) < least_cosine) return;
    pairs[i] = {cage_point(grid, source.at_rest.points[i]), at.point, normal, at.distance,
                static_cast<double>(own_stride) * source.frames.point_areas[i]};
  });
  core::parallel_for(other, pair_grain, [&](std::size_t i) {
    if (i % other_stride != 0) return;
    const Meeting at = source.tree.closest(target.now.points[i], target.meet[i]);
    target.meet[i] = at.triangle;
    met_by_target[i] = at;
    const Vec3& normal = target.frames.point_normals[i];
    if (normal.dot(source.frames.triangle_normals[static_cast<std::size_t>(at.triangle)]) < least_cosine)
      return;
    pairs[own + i] = {cage_point(grid, place_at(source.at_rest, at)), target.now.points[i], normal,
                      at.distance, static_cast<double>(other_stride) * target.frames.point_areas[i]};
  });
  weigh(pairs.data(), met, source.tree, rules.looseness);
  weigh(pairs.data() + own, met_by_target, target.tree, rules.looseness);
  return pairs;
}

PairingVertices::PairingVertices(const TriMesh& mesh)
    : tree(mesh.points), normals(SurfaceFrames(mesh).point_normals) {}

std::vector<SurfacePair> vertex_pairs(const TriMesh& carried, const std::vector<geometry::CagePoint>& places,
                                      const PairingVertices& target, double max_angle_deg) {
  const double least_cosine = least_cosine_of(max_angle_deg);
  const std::vector<Vec3> normals = SurfaceFrames(carried).point_normals;
  std::vector<SurfacePair> pairs(carried.points.size());
  core::parallel_for(pairs.size(), pair_grain, [&](std::size_t i) {
    const auto closest = static_cast<std::size_t>(target.tree.nearest(carried.points[i]));
    const Vec3 &place = target.tree.points()[closest], &normal = target.normals[closest];
    if (normal.dot(normals[i]) < least_cosine) return;
    pairs[i] = {places[i], place, normal, (place - carried.points[i]).norm(), 1.0};
  });
  return pairs;
}

}  // namespace ostia::motion
