#pragma once
/// \file Vessels as CAD programs export them: a wall of some thickness, one closed shell.

#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/tri_mesh.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::testing {

using Loop = std::vector<std::int32_t>;

inline geometry::Vec3 middle_of(const geometry::TriMesh& mesh, const Loop& loop) {
  geometry::Vec3 sum = geometry::Vec3::Zero();
  for (const std::int32_t p : loop) sum += mesh.points[static_cast<std::size_t>(p)];
  return sum / static_cast<double>(loop.size());
}

/// Triangles between two loops about one middle, the shorter way across at each step.
inline void zip(geometry::TriMesh& mesh, const Loop& one, Loop other) {
  const auto at = [&](std::int32_t p) -> const geometry::Vec3& {
    return mesh.points[static_cast<std::size_t>(p)];
  };
  const auto ahead = [&](const Loop& loop) {
    const geometry::Vec3 middle = middle_of(mesh, loop);
    geometry::Vec3 area = geometry::Vec3::Zero();
    for (std::size_t i = 0; i < loop.size(); ++i)
      area += (at(loop[i]) - middle).cross(at(loop[(i + 1) % loop.size()]) - middle);
    return area;
  };
  if (ahead(one).dot(ahead(other)) < 0.0) std::reverse(other.begin(), other.end());
  const auto nearest =
      std::ranges::min_element(other, {}, [&](std::int32_t p) { return (at(p) - at(one.front())).norm(); });
  std::rotate(other.begin(), nearest, other.end());
  std::size_t i = 0, k = 0;
  while (i < one.size() || k < other.size()) {
    const std::int32_t a = one[i % one.size()], b = other[k % other.size()];
    const std::int32_t next_a = one[(i + 1) % one.size()], next_b = other[(k + 1) % other.size()];
    const bool along_one =
        k == other.size() || (i < one.size() && (at(next_a) - at(b)).norm() <= (at(next_b) - at(a)).norm());
    mesh.triangles.push_back(along_one ? geometry::Triangle{a, next_a, b} : geometry::Triangle{a, next_b, b});
    ++(along_one ? i : k);
  }
}

/// Lumen and outside of its wall, both open and outward, joined by flat rings at their ends; outward.
inline geometry::TriMesh thick_walled(const geometry::TriMesh& lumen, const geometry::TriMesh& outside) {
  geometry::TriMesh shell = geometry::merged(lumen, outside);
  const auto before = static_cast<std::int32_t>(lumen.points.size());
  for (const Loop& inner : geometry::boundary_loops(lumen)) {
    std::vector<Loop> outer = geometry::boundary_loops(outside);
    for (Loop& loop : outer)
      for (std::int32_t& p : loop) p += before;
    const auto same_end = std::ranges::min_element(outer, {}, [&](const Loop& loop) {
      return (middle_of(shell, loop) - middle_of(shell, inner)).norm();
    });
    zip(shell, inner, *same_end);
  }
  return geometry::oriented(shell);
}

}  // namespace ostia::testing
