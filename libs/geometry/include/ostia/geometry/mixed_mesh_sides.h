#pragma once
/// \file The edges and sides of a volume mesh's elements: which two share a side, and which are free.

#include "ostia/geometry/mixed_mesh.h"

namespace ostia::geometry {

/// Corners of an element's edges by their places in the element, in the order of its second-order nodes.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::size_t, 2>, 9> prism_edges = {
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};

/// The second-order node in the middle of two points of an element (tetrahedra are counted first, then
/// prisms); -1 where they are no edge of it.
std::int32_t edge_node(const MixedMesh& mesh, std::size_t element, std::int32_t a, std::int32_t b);

/// Corners of an element's sides, outward, by their places in the element; the fourth of a triangle is -1.
inline constexpr std::array<std::array<int, 4>, 4> tetrahedron_sides = {
    {{0, 2, 1, -1}, {0, 1, 3, -1}, {1, 2, 3, -1}, {0, 3, 2, -1}}};
inline constexpr std::array<std::array<int, 4>, 5> prism_sides = {
    {{0, 2, 1, -1}, {3, 4, 5, -1}, {0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};

/// A side with the mesh's points at its corners; the fourth of a triangle is -1.
struct MeshSide {
  std::array<std::int32_t, 4> key;      ///< sorted: the same from both elements
  std::array<std::int32_t, 4> outward;  ///< as its element has it
  std::int32_t element;                 ///< tetrahedra are counted first, then prisms
  std::int32_t side;                    ///< index into the lists above
  bool triangle() const { return outward[3] < 0; }
};

/// All sides of all elements, those of one key together; within a key by element.
std::vector<MeshSide> sorted_sides(const MixedMesh& mesh);

/// Replaces the boundary by the sides that one element alone has, in the order of their elements, all of
/// face 1, `wall`; with their second-order nodes in a quadratic mesh.
void take_free_sides_as_boundary(MixedMesh& mesh);

/// The boundary as triangles, quadrilaterals cut as split_prisms cuts them; on all points of the mesh.
TriMesh boundary_triangles(const MixedMesh& mesh);

}  // namespace ostia::geometry
