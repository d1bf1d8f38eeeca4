#include "ostia/geometry/non_manifold.h"

#include "edge_table.h"
#include "mesh_checks.h"

#include <algorithm>
#include <map>
#include <utility>
#include <vector>

namespace ostia::geometry {
namespace {

using detail::HalfEdge;

constexpr double nudge = 1e-3;

/// Triangles joined across edges of two.
DisjointSets patches_of(const TriMesh& mesh, const std::vector<HalfEdge>& table) {
  DisjointSets patches(mesh.triangles.size());
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    if (last - first == 2) patches.join(first[0].triangle, first[1].triangle);
  });
  return patches;
}

/// The triangles at an edge in groups that go on into each other there.
std::vector<std::vector<const HalfEdge*>> sheets_at(const HalfEdge* first, const HalfEdge* last,
                                                    DisjointSets& patches) {
  std::map<std::int32_t, std::vector<const HalfEdge*>> by_patch;
  std::vector<const HalfEdge*> all;
  for (const HalfEdge* h = first; h != last; ++h) {
    by_patch[patches.find(h->triangle)].push_back(h);
    all.push_back(h);
  }
  const bool pairs =
      std::all_of(by_patch.begin(), by_patch.end(), [](const auto& p) { return p.second.size() == 2; });
  std::vector<std::vector<const HalfEdge*>> sheets;
  if (all.size() > 2 && pairs) {
    for (auto& entry : by_patch) sheets.push_back(std::move(entry.second));
  } else {
    sheets.push_back(std::move(all));
  }
  return sheets;
}

std::int32_t corner_at(const TriMesh& mesh, std::int32_t triangle, std::int32_t point) {
  const Triangle& t = mesh.triangles[static_cast<std::size_t>(triangle)];
  return 3 * triangle + (t[0] == point ? 0 : t[1] == point ? 1 : 2);
}

/// Corners of triangles that share their point for good: 3 t + i for corner i of triangle t.
DisjointSets fans_of(const TriMesh& mesh) {
  const std::vector<HalfEdge> table = detail::half_edges(mesh);
  DisjointSets patches = patches_of(mesh, table);
  DisjointSets fans(3 * mesh.triangles.size());
  detail::for_each_edge(table, [&](const HalfEdge* first, const HalfEdge* last) {
    for (const auto& sheet : sheets_at(first, last, patches))
      for (const HalfEdge* h : sheet)
        for (const std::int32_t p : {h->low, h->high})
          fans.join(corner_at(mesh, sheet.front()->triangle, p), corner_at(mesh, h->triangle, p));
  });
  return fans;
}

}  // namespace

Separated separated(const TriMesh& mesh) {
  detail::check_indices(mesh, "taking a surface apart");
  DisjointSets fans = fans_of(mesh);
  Separated out{mesh, 0};
  std::vector<std::int32_t> owner(mesh.points.size(), -1);  // the fan that keeps the point
  struct Copy {
    std::int32_t point;
    Vec3 sum = Vec3::Zero();
    int count = 0;
  };
  std::map<std::int32_t, Copy> copies;  // by fan
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    if (detail::repeats_a_corner(mesh.triangles[t])) continue;
    const Vec3 centre =
        (detail::corner(mesh, mesh.triangles[t], 0) + detail::corner(mesh, mesh.triangles[t], 1) +
         detail::corner(mesh, mesh.triangles[t], 2)) /
        3.0;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::int32_t fan = fans.find(static_cast<std::int32_t>(3 * t + i));
      std::int32_t& p = out.mesh.triangles[t][i];
      std::int32_t& first = owner[static_cast<std::size_t>(p)];
      if (first < 0) first = fan;
      if (first == fan) continue;
      const auto next = static_cast<std::int32_t>(mesh.points.size() + copies.size());
      Copy& copy = copies.try_emplace(fan, Copy{next}).first->second;
      copy.sum += centre - mesh.points[static_cast<std::size_t>(p)];
      ++copy.count;
      if (copy.point == next) out.mesh.points.push_back(mesh.points[static_cast<std::size_t>(p)]);
      p = copy.point;
    }
  }
  for (const auto& [fan, copy] : copies)
    out.mesh.points[static_cast<std::size_t>(copy.point)] += nudge * copy.sum / copy.count;
  out.added_points = copies.size();
  return out;
}

}  // namespace ostia::geometry
