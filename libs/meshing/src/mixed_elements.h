#pragma once
/// \file Edges and sides of tetrahedra and prisms, by their corners' places.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstddef>
#include <string>

namespace ostia::meshing {

// In the order of MixedMesh's second-order nodes.
inline constexpr std::array<std::array<std::size_t, 2>, 6> tetrahedron_edges{
    {{0, 1}, {1, 2}, {2, 0}, {0, 3}, {1, 3}, {2, 3}}};
inline constexpr std::array<std::array<std::size_t, 2>, 9> prism_edges{
    {{0, 1}, {1, 2}, {2, 0}, {3, 4}, {4, 5}, {5, 3}, {0, 3}, {1, 4}, {2, 5}}};
/// Outward.
inline constexpr std::array<std::array<std::size_t, 4>, 3> prism_quads{
    {{0, 1, 4, 3}, {1, 2, 5, 4}, {2, 0, 3, 5}}};

/// Throws InvalidInput, with `what` before it, for indices out of range, lists of different lengths, and
/// points that are not finite.
void check_lists(const geometry::MixedMesh& mesh, const std::string& what);

}  // namespace ostia::meshing
