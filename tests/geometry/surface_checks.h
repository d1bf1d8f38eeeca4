#pragma once
/// \file Counts on surfaces, by means other than the library's own.

#include "ostia/geometry/tri_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>
#include <utility>

namespace ostia::geometry::test {

/// What half-edges and corners tell of a surface.
struct Topology {
  std::size_t repeated_half_edges =
      0;  ///< two triangles that run along an edge the same way: non-manifold or ill-oriented
  std::size_t border_half_edges = 0;
  std::size_t border_loops = 0;
  std::size_t pinched_vertices = 0;  ///< triangles around it form more than one fan
  long euler = 0;
  double smallest_area = 0.0;
};

inline Topology topology_of(const TriMesh& mesh) {
  Topology result;
  std::map<std::pair<std::int32_t, std::int32_t>, int> half_edges;
  std::map<std::int32_t, std::map<std::int32_t, std::int32_t>> links;  // around each vertex: from -> to
  result.smallest_area = 1e300;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    result.smallest_area = std::min(result.smallest_area, 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm());
    for (std::size_t c = 0; c < 3; ++c) {
      ++half_edges[{t[c], t[(c + 1) % 3]}];
      links[t[c]][t[(c + 1) % 3]] = t[(c + 2) % 3];
    }
  }
  std::map<std::int32_t, std::int32_t> border;
  for (const auto& [edge, count] : half_edges) {
    if (count > 1) ++result.repeated_half_edges;
    if (half_edges.count({edge.second, edge.first})) continue;
    ++result.border_half_edges;
    border[edge.first] = edge.second;
  }
  for (auto& [vertex, link] : links) {
    std::set<std::int32_t> ends;
    for (const auto& [from, to] : link) ends.insert(to);
    std::int32_t at = link.begin()->first;  // an open fan starts where nothing leads to
    for (const auto& [from, to] : link) {
      if (!ends.count(from)) at = from;
    }
    std::size_t steps = 0;
    while (link.count(at) && steps <= link.size()) {
      at = link.at(at);
      ++steps;
      if (steps == link.size()) break;
    }
    if (steps != link.size()) ++result.pinched_vertices;
  }
  while (!border.empty()) {
    ++result.border_loops;
    for (std::int32_t v = border.begin()->first; border.count(v);) {
      const std::int32_t next = border.at(v);
      border.erase(v);
      v = next;
    }
  }
  const auto edges = static_cast<long>((half_edges.size() + result.border_half_edges) / 2);
  result.euler = static_cast<long>(links.size()) - edges + static_cast<long>(mesh.triangles.size());
  return result;
}

inline double area_of(const TriMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    sum += 0.5 * (at(1) - at(0)).cross(at(2) - at(0)).norm();
  }
  return sum;
}

inline double volume_of(const TriMesh& mesh) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const auto at = [&](std::size_t c) { return mesh.points[static_cast<std::size_t>(t[c])]; };
    sum += at(0).dot(at(1).cross(at(2))) / 6.0;
  }
  return sum;
}

/// The smallest angle of all triangles, in degrees.
inline double smallest_angle_deg(const TriMesh& mesh) {
  double smallest = 180.0;
  for (const Triangle& t : mesh.triangles) {
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3& p = mesh.points[static_cast<std::size_t>(t[c])];
      const Vec3 u = mesh.points[static_cast<std::size_t>(t[(c + 1) % 3])] - p;
      const Vec3 v = mesh.points[static_cast<std::size_t>(t[(c + 2) % 3])] - p;
      smallest = std::min(smallest, std::atan2(u.cross(v).norm(), u.dot(v)) * 180.0 / std::numbers::pi);
    }
  }
  return smallest;
}

inline void expect_closed_manifold(const TriMesh& mesh, long euler) {
  const Topology t = topology_of(mesh);
  EXPECT_EQ(t.repeated_half_edges, 0u);
  EXPECT_EQ(t.border_half_edges, 0u);
  EXPECT_EQ(t.pinched_vertices, 0u);
  EXPECT_EQ(t.euler, euler);
  EXPECT_GT(t.smallest_area, 0.0);
}

}  // namespace ostia::geometry::test
