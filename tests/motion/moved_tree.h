#pragma once
/// \file A coronary-like tree under a known motion, for tests and benchmarks.

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/analytic_shapes.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

namespace ostia::motion::testing {

using geometry::TriMesh;
using geometry::Vec3;

/// As the heart's wall moves: shorter, thinner, turned about its long axis more towards the apex, shifted.
/// `amount` 1 is about 12 mm at the farthest.
inline Vec3 beat(const Vec3& p, double amount) {
  const Vec3 centre(20.0, 10.0, 30.0);
  Vec3 q = p - centre;
  const double turn = amount * 0.2 * (1.0 + q.z() / 40.0);
  q = Eigen::AngleAxisd(turn, Vec3::UnitZ()) * q;
  q.x() *= 1.0 - 0.12 * amount;
  q.y() *= 1.0 - 0.12 * amount;
  q.z() *= 1.0 - 0.15 * amount;
  return centre + q + amount * Vec3(2.0 * std::sin(q.z() / 25.0), 3.0, 4.0);
}

inline TriMesh moved(TriMesh mesh, double amount) {
  for (Vec3& p : mesh.points) p = beat(p, amount);
  return mesh;
}

inline TriMesh noisy(TriMesh mesh, double mm) {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0.0, mm);
  for (Vec3& p : mesh.points) p += Vec3(noise(random), noise(random), noise(random));
  return mesh;
}

struct Error {
  double mean = 0.0, worst = 0.0;
};
inline Error vertex_error(const TriMesh& template_mesh, const TriMesh& result, double amount) {
  Error e;
  for (std::size_t i = 0; i < result.points.size(); ++i) {
    const double off = (result.points[i] - beat(template_mesh.points[i], amount)).norm();
    e.mean += off / static_cast<double>(result.points.size());
    e.worst = std::max(e.worst, off);
  }
  return e;
}

/// Mean distance from the target to the result, as in [Yi] 5.1.
inline double target_distance(const TriMesh& target, const TriMesh& result) {
  const geometry::AabbTree tree(result);
  double sum = 0.0;
  for (const Vec3& p : target.points) sum += tree.closest(p).distance;
  return sum / static_cast<double>(target.points.size());
}

/// Without the triangles of a place: a segmentation that lost a branch there.
inline TriMesh without(const TriMesh& mesh, const geometry::Box3& place) {
  TriMesh out{mesh.points, {}};
  std::vector<std::int32_t> number(mesh.points.size(), -1);
  out.points.clear();
  for (const geometry::Triangle& t : mesh.triangles) {
    if (place.contains(mesh.points[static_cast<std::size_t>(t[0])])) continue;
    geometry::Triangle kept{};
    for (std::size_t i = 0; i < 3; ++i) {
      std::int32_t& n = number[static_cast<std::size_t>(t[i])];
      if (n < 0) {
        n = static_cast<std::int32_t>(out.points.size());
        out.points.push_back(mesh.points[static_cast<std::size_t>(t[i])]);
      }
      kept[i] = n;
    }
    out.triangles.push_back(kept);
  }
  return out;
}

/// 10,462 points, as the template of a study has.
inline TriMesh template_tree() {
  return geometry::surface_of(geometry::coronary_like_tree(), 0.43, false);
}

/// The same tree in other triangles, moved, with 0.05 mm of noise.
inline TriMesh target_tree(double amount) {
  return noisy(moved(geometry::surface_of(geometry::coronary_like_tree(), 0.455, false), amount), 0.05);
}

}  // namespace ostia::motion::testing
