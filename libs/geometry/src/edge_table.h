#pragma once
/// \file The edges of a triangle surface, sorted, with the triangles on each.

#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/tri_mesh.h"

#include <compare>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::geometry::detail {

/// One triangle's side. Triangles that repeat a corner have none.
struct HalfEdge {
  std::int32_t low = 0;   ///< lower vertex
  std::int32_t high = 0;  ///< higher vertex
  std::int32_t triangle = 0;
  std::int8_t side = 0;    ///< from corner `side` to the next one
  bool ascending = false;  ///< runs from `low` to `high`

  std::int32_t from() const { return ascending ? low : high; }
  std::int32_t to() const { return ascending ? high : low; }
};

/// Half-edges sorted by edge, then by triangle.
std::vector<HalfEdge> half_edges(const TriMesh& mesh);

/// Calls use(first, last) with the half-edges of each edge in turn.
template <class Use>
void for_each_edge(const std::vector<HalfEdge>& table, const Use& use) {
  for (std::size_t first = 0; first < table.size();) {
    std::size_t last = first + 1;
    while (last < table.size() && table[last].low == table[first].low &&
           table[last].high == table[first].high)
      ++last;
    use(table.data() + first, table.data() + last);
    first = last;
  }
}

/// A triangle's corners, ascending.
struct CornersOfTriangle {
  Triangle corners{};
  std::int32_t triangle = 0;
  auto operator<=>(const CornersOfTriangle&) const = default;
};

/// All of them in order: those of the same three corners stand together, by their triangles.
std::vector<CornersOfTriangle> sorted_corners(const TriMesh& mesh);

/// What the functions of mesh_topology.h tell, where the table is there already.
std::vector<std::vector<std::int32_t>> boundary_loops(const TriMesh& mesh,
                                                      const std::vector<HalfEdge>& table);
std::vector<std::int32_t> components(const TriMesh& mesh, const std::vector<HalfEdge>& table);

/// For each point the lowest point with the same coordinates; a point that is not finite stands for itself.
std::vector<std::int32_t> first_equal_points(const std::vector<Vec3>& points);

}  // namespace ostia::geometry::detail
