#pragma once
/// \file Surfaces that touch themselves at points and edges, taken apart.

#include "ostia/geometry/tri_mesh.h"

#include <cstddef>

namespace ostia::geometry {

struct Separated {
  TriMesh mesh;                  ///< the input's triangles, in its order; new points come last
  std::size_t added_points = 0;  ///< 0: nothing touched
};
/// Gives each sheet a point of its own where several fans of triangles meet in one (a non-manifold vertex),
/// or where pairs of triangles, each pair of one sheet, meet along an edge. A new point is moved into its own
/// sheet by a thousandth of the way to the middle of its triangles, so that equal points joined later do not
/// undo it. An edge where three or more sheets join stays: one of them has to go (a flap). Throws
/// InvalidInput for triangles that name points that are not there.
Separated separated(const TriMesh& mesh);

}  // namespace ostia::geometry
