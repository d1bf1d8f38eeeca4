#pragma once
/// \file The sides of a volume mesh's elements: which two share one, and which are free.

#include "ostia/geometry/mixed_mesh.h"

namespace ostia::geometry {

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
