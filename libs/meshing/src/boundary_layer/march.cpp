#include "boundary_layer/march.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <queue>
#include <utility>

namespace ostia::meshing {

using geometry::Vec3;

namespace {

constexpr double kept_share = 0.8;  // of the largest least product, while directions are smoothed
constexpr int smoothing_rounds = 12;

/// Inward normals of a ring's two edges at each of its points, in the cap's plane: the layers stay in the
/// cap.
void add_ring_edges(const LayerWall& wall, std::vector<SightCone>& cones) {
  for (const WallRing& ring : wall.rings)
    for (std::size_t i = 0; i < ring.loop.size(); ++i) {
      const std::int32_t a = ring.loop[i], b = ring.loop[(i + 1) % ring.loop.size()];
      // The wall's winding has the hole to its right.
      const Vec3 inward = ring.normal.cross(wall.point(a) - wall.point(b)).normalized();
      cones[static_cast<std::size_t>(a)].push_back(inward);
      cones[static_cast<std::size_t>(b)].push_back(inward);
    }
}

Vec3 smoothed_direction(const LayerWall& wall, const std::vector<Vec3>& directions, std::int32_t v) {
  Vec3 sum = directions[static_cast<std::size_t>(v)];
  for (const std::int32_t u : wall.neighbours[static_cast<std::size_t>(v)])
    sum += directions[static_cast<std::size_t>(u)];
  return wall.admissible(v, sum);
}

/// The largest ball of a direction that the wall leaves room for.
double ball_radius(const geometry::AabbTree& tree, const Vec3& p, const Vec3& direction, double visibility,
                   double most) {
  constexpr double slack = 0.9;  // facets come nearer than the wall they stand for
  double radius = most;
  for (int round = 0; round < 40; ++round) {
    const Vec3 centre = p + radius * direction;
    const geometry::SurfacePoint nearest = tree.closest(centre);
    if (nearest.distance >= slack * visibility * radius) return radius;
    // The ball through p and the nearest point (Ma, Bae and Choi 2012), no smaller than half of this one.
    const Vec3 to = nearest.point - p;
    const double along = 2.0 * to.dot(direction);
    const double touching = along > 0.0 ? to.squaredNorm() / along : 0.0;
    radius = std::clamp(touching, 0.5 * radius, 0.97 * radius);
  }
  return radius;
}

}  // namespace

std::vector<SightCone> ring_edges(const LayerWall& wall) {
  std::vector<SightCone> edges(wall.mesh.points.size());
  add_ring_edges(wall, edges);
  return edges;
}

SightCone sight_cone(const LayerWall& wall, const std::vector<SightCone>& edges, std::int32_t v) {
  const auto i = static_cast<std::size_t>(v);
  SightCone cone;
  for (const std::int32_t f : wall.triangles_of[i]) {
    const geometry::Triangle& t = wall.mesh.triangles[static_cast<std::size_t>(f)];
    const auto k = static_cast<std::size_t>(std::find(t.begin(), t.end(), v) - t.begin());
    const Vec3 a = (wall.point(t[(k + 1) % 3]) - wall.point(v)).normalized(),
               b = (wall.point(t[(k + 2) % 3]) - wall.point(v)).normalized();
    Vec3 inward = -2.0 / std::numbers::sqrt3 * a.cross(b);
    if (wall.ring_of[i] >= 0) {
      const Vec3& normal = wall.rings[static_cast<std::size_t>(wall.ring_of[i])].normal;
      inward -= inward.dot(normal) * normal;
    }
    cone.push_back(inward);
  }
  cone.insert(cone.end(), edges[i].begin(), edges[i].end());
  return cone;
}

std::vector<SightCone> sight_cones(const LayerWall& wall) {
  std::vector<SightCone> cones = ring_edges(wall);
  for (std::size_t v = 0; v < cones.size(); ++v)
    cones[v] = sight_cone(wall, cones, static_cast<std::int32_t>(v));
  return cones;
}

double least_product(const SightCone& cone, const Vec3& direction) {
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& m : cone) least = std::min(least, m.dot(direction));
  return least;
}

Vec3 most_visible(const SightCone& cone) {
  // The largest least product over unit directions is the norm of the point of the cone's convex hull nearest
  // to the origin, and the direction that of this point (Gilbert 1966).
  Vec3 x = Vec3::Zero();
  for (const Vec3& m : cone) x += m / static_cast<double>(cone.size());
  for (int round = 0; round < 200; ++round) {
    const Vec3& s = *std::min_element(cone.begin(), cone.end(),
                                      [&](const Vec3& a, const Vec3& b) { return a.dot(x) < b.dot(x); });
    const Vec3 step = s - x;
    const double squared = step.squaredNorm();
    if (!(squared > 1e-20)) break;
    x += std::clamp(-x.dot(step) / squared, 0.0, 1.0) * step;
  }
  return x.squaredNorm() > 0.0 ? x.normalized() : Vec3(Vec3::UnitX());
}

std::vector<Vec3> march_directions(const LayerWall& wall, const std::vector<SightCone>& cones) {
  const std::size_t n = wall.mesh.points.size();
  const std::vector<Vec3> normals = geometry::vertex_normals(wall.mesh);
  std::vector<Vec3> directions(n);
  std::vector<double> required(n);
  core::parallel_for(n, 256, [&](std::size_t i) {
    const Vec3 best = most_visible(cones[i]);
    required[i] = kept_share * least_product(cones[i], best);
    const Vec3 plain = wall.admissible(static_cast<std::int32_t>(i), -normals[i]);
    directions[i] = least_product(cones[i], plain) >= required[i] ? plain : best;
  });
  constexpr double no_more_than_rounding = 1e-7;  // needles have small products, yet they are seen
  for (std::size_t i = 0; i < n; ++i)
    if (!(required[i] > no_more_than_rounding))
      throw GeometryError("boundary layers: the wall folds so sharply near " +
                          place_text(wall.mesh.points[i]) +
                          " that no direction sees all triangles there; smooth or remesh the surface");
  for (int round = 0; round < smoothing_rounds; ++round) {
    const std::vector<Vec3> old = directions;
    core::parallel_for(n, 512, [&](std::size_t i) {
      const Vec3 candidate = smoothed_direction(wall, old, static_cast<std::int32_t>(i));
      if (candidate.allFinite() && least_product(cones[i], candidate) >= required[i])
        directions[i] = candidate;
    });
  }
  return directions;
}

std::vector<double> room(const LayerWall& wall, const std::vector<Vec3>& directions,
                         const std::vector<double>& most, const core::TaskContext& task) {
  const geometry::AabbTree tree(wall.mesh);
  std::vector<double> radii(directions.size());
  core::parallel_chunks(radii.size(), 256, [&](std::size_t first, std::size_t last) {
    task.throw_if_cancelled();
    for (std::size_t i = first; i < last; ++i) {
      double visibility = 1.0;
      for (const std::int32_t f : wall.triangles_of[i]) {
        const geometry::Triangle& t = wall.mesh.triangles[static_cast<std::size_t>(f)];
        const Vec3 normal =
            (wall.point(t[1]) - wall.point(t[0])).cross(wall.point(t[2]) - wall.point(t[0])).normalized();
        visibility = std::min(visibility, -normal.dot(directions[i]));
      }
      radii[i] = ball_radius(tree, wall.mesh.points[i], directions[i], std::max(visibility, 0.0), most[i]);
    }
  });
  return radii;
}

void limit_shares(const LayerWall& wall, const std::vector<double>& wanted, double gradation,
                  std::vector<double>& shares) {
  using Item = std::pair<double, std::int32_t>;
  std::priority_queue<Item, std::vector<Item>, std::greater<>> queue;
  for (std::size_t i = 0; i < shares.size(); ++i)
    if (shares[i] < 1.0) queue.emplace(shares[i], static_cast<std::int32_t>(i));
  while (!queue.empty()) {
    const auto [share, from] = queue.top();
    queue.pop();
    if (share > shares[static_cast<std::size_t>(from)]) continue;
    for (const std::int32_t to : wall.neighbours[static_cast<std::size_t>(from)]) {
      const auto j = static_cast<std::size_t>(to);
      const double limit = share + gradation * (wall.point(to) - wall.point(from)).norm() / wanted[j];
      if (limit < shares[j]) {
        shares[j] = limit;
        queue.emplace(limit, to);
      }
    }
  }
}

}  // namespace ostia::meshing
