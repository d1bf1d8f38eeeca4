#pragma once
/// \file Edges and sides of tetrahedra and prisms, by their corners' places.

#include "ostia/geometry/mixed_mesh_sides.h"

#include <array>
#include <cstddef>
#include <string>

namespace ostia::meshing {

using geometry::prism_edges;
using geometry::tetrahedron_edges;

/// Outward.
inline constexpr std::array<std::array<std::size_t, 4>, 3> prism_quads{
    {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};

/// Throws InvalidInput, with `what` before it, for indices out of range, lists of different lengths, and
/// points that are not finite.
void check_lists(const geometry::MixedMesh& mesh, const std::string& what);

}  // namespace ostia::meshing
