#pragma once
/// \file How a surface passes through one cube, for each of the 256 sign patterns of its corners: the table
/// of marching cubes that is consistent across faces (docs/methods/isosurface.md).

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// Corner c of a cube is at (c & 1, c >> 1 & 1, c >> 2). Edge 4 a + b runs along axis a; b numbers its place
/// across: for axis a with the other two axes p < q, b = (bit p) + 2 (bit q).
struct CubeEdge {
  int from, to, axis;
};
const std::array<CubeEdge, 12>& cube_edges();

/// Triangles of one pattern by their cube edges, at most five; counter-clockwise seen from outside.
using CubePattern = std::vector<std::array<std::uint8_t, 3>>;
/// Bit c of the index is set where corner c is inside.
const std::array<CubePattern, 256>& cube_patterns();

/// Smallest distance, in grid steps, of a vertex from a grid node: keeps triangles from being degenerate.
inline constexpr double node_clearance = 1e-3;

}  // namespace ostia::geometry
