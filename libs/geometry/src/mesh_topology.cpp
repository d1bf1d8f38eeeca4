#include "ostia/geometry/mesh_topology.h"

#include "edge_table.h"
#include "mesh_checks.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

using detail::corner;
using detail::HalfEdge;

double angle_between(const Vec3& u, const Vec3& v) {
  return std::atan2(u.cross(v).norm(), u.dot(v));
}

}  // namespace

double area(const TriMesh& mesh) {
  detail::check_indices(mesh, "area");
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    sum += (corner(mesh, t, 1) - corner(mesh, t, 0)).cross(corner(mesh, t, 2) - corner(mesh, t, 0)).norm();
  }
  return 0.5 * sum;
}

double volume(const TriMesh& mesh) {
  detail::check_indices(mesh, "volume");
  if (mesh.triangles.empty()) return 0.0;
  // Seen from a point of the surface: far from the world's origin the terms would cancel.
  const Vec3 from = corner(mesh, mesh.triangles.front(), 0);
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = corner(mesh, t, 0) - from, b = corner(mesh, t, 1) - from, c = corner(mesh, t, 2) - from;
    sum += a.dot(b.cross(c));
  }
  return sum / 6.0;
}

double volume(const VolumeMesh& mesh) {
  double sum = 0.0;
  for (const Tetrahedron& t : mesh.tetrahedra) {
    for (const std::int32_t p : t) {
      if (p < 0 || static_cast<std::size_t>(p) >= mesh.points.size()) {
        throw InvalidInput("volume: a tetrahedron names point " + std::to_string(p) + ", but the mesh has " +
                           std::to_string(mesh.points.size()) + " points; the file is damaged");
      }
    }
    const auto at = [&](std::size_t i) -> const Vec3& { return mesh.points[static_cast<std::size_t>(t[i])]; };
    sum += (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0));
  }
  return sum / 6.0;
}

Box3 bounds(const std::vector<Vec3>& points) {
  Box3 box;
  for (const Vec3& p : points) box.extend(p);
  return box;
}

std::vector<Vec3> vertex_normals(const TriMesh& mesh) {
  detail::check_indices(mesh, "vertex normals");
  std::vector<Vec3> normals(mesh.points.size(), Vec3::Zero());
  for (const Triangle& t : mesh.triangles) {
    const Vec3 sides[3] = {corner(mesh, t, 1) - corner(mesh, t, 0), corner(mesh, t, 2) - corner(mesh, t, 1),
                           corner(mesh, t, 0) - corner(mesh, t, 2)};
    const Vec3 normal = sides[0].cross(sides[1]).stableNormalized();
    if (!normal.allFinite()) continue;
    for (std::size_t i = 0; i < 3; ++i) {
      const double angle = angle_between(sides[i], -sides[(i + 2) % 3]);
      if (std::isfinite(angle)) normals[static_cast<std::size_t>(t[i])] += angle * normal;
    }
  }
  for (Vec3& n : normals) n.stableNormalize();
  return normals;
}

std::vector<std::vector<std::int32_t>> vertex_neighbours(const TriMesh& mesh) {
  detail::check_indices(mesh, "vertex neighbours");
  std::vector<std::vector<std::int32_t>> neighbours(mesh.points.size());
  for (auto& list : neighbours) list.reserve(8);
  // Edges come sorted by their lower, then their higher vertex: every list fills in ascending order.
  detail::for_each_edge(detail::half_edges(mesh), [&](const HalfEdge* edge, const HalfEdge*) {
    neighbours[static_cast<std::size_t>(edge->high)].push_back(edge->low);
    neighbours[static_cast<std::size_t>(edge->low)].push_back(edge->high);
  });
  return neighbours;
}

std::vector<std::vector<std::int32_t>> boundary_loops(const TriMesh& mesh) {
  detail::check_indices(mesh, "boundary loops");
  return detail::boundary_loops(mesh, detail::half_edges(mesh));
}

std::vector<std::vector<std::int32_t>> detail::boundary_loops(const TriMesh& mesh,
                                                              const std::vector<HalfEdge>& table) {
  std::vector<std::int32_t> next(mesh.points.size(), -1);
  std::vector<std::int32_t> starts;
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first != 1) return;
    std::int32_t& after = next[static_cast<std::size_t>(first->from())];
    if (after >= 0) {
      throw GeometryError(
          "boundary loops: more than one border chain leaves vertex " + std::to_string(first->from()) +
          "; the border is not a set of simple loops: repair the surface there (non-manifold vertex or "
          "triangles turned against each other)");
    }
    after = first->to();
    starts.push_back(first->from());
  });
  std::sort(starts.begin(), starts.end());
  std::vector<std::vector<std::int32_t>> loops;
  for (const std::int32_t start : starts) {
    if (next[static_cast<std::size_t>(start)] < 0) continue;  // already in a loop
    std::vector<std::int32_t> loop;
    for (std::int32_t v = start;;) {
      loop.push_back(v);
      const std::int32_t after = std::exchange(next[static_cast<std::size_t>(v)], -1);
      if (after < 0) {
        throw GeometryError("boundary loops: the border chain from vertex " + std::to_string(start) +
                            " ends at vertex " + std::to_string(v) +
                            " without closing; turn the triangles the same way with oriented() first");
      }
      if (after == start) break;
      v = after;
    }
    loops.push_back(std::move(loop));
  }
  std::stable_sort(loops.begin(), loops.end(),
                   [](const auto& a, const auto& b) { return a.size() > b.size(); });
  return loops;
}

std::vector<std::int32_t> components(const TriMesh& mesh) {
  detail::check_indices(mesh, "components");
  return detail::components(mesh, detail::half_edges(mesh));
}

std::vector<std::int32_t> detail::components(const TriMesh& mesh, const std::vector<HalfEdge>& table) {
  DisjointSets sets(mesh.triangles.size());
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    for (const HalfEdge* other = first + 1; other != last; ++other)
      sets.join(first->triangle, other->triangle);
  });
  std::vector<std::int32_t> numbers(mesh.triangles.size());
  std::int32_t count = 0;
  for (std::size_t t = 0; t < numbers.size(); ++t) {
    const std::int32_t lowest = sets.find(static_cast<std::int32_t>(t));
    numbers[t] = lowest == static_cast<std::int32_t>(t) ? count++ : numbers[static_cast<std::size_t>(lowest)];
  }
  return numbers;
}

}  // namespace ostia::geometry
