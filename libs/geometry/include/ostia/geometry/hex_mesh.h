#pragma once
/// \file Volume meshes of hexahedra, as they are swept along vessels.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// Two quadrilaterals, 0123 and 4567, and the edges between them, 0-4 to 3-7; 0123 is counter-clockwise seen
/// from 4567 (VTK's order).
using Hexahedron = std::array<std::int32_t, 8>;

/// A mesh of hexahedra with its whole boundary, outward, which refers to the same points.
struct HexMesh {
  std::vector<Vec3> points;
  std::vector<Hexahedron> hexahedra;
  std::vector<Quad> quads;
  std::vector<std::int32_t> quad_face_ids;
  std::vector<Face> faces;
};

/// The six sides, outward, by the corners' places in the hexahedron.
inline constexpr std::array<std::array<int, 4>, 6> hexahedron_sides = {
    {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4}, {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}}};

/// Volume by six tetrahedra about the diagonal 0-6, mm3.
double volume(const HexMesh& mesh, const Hexahedron& hexahedron);
/// The least over the corners of det(e1, e2, e3) / (|e1| |e2| |e3|), edges out of the corner (P. M. Knupp,
/// Int. J. Numer. Methods Eng. 48:1165-1185, 2000): 1 in a box, 0 or less where it is folded; -1 with an edge
/// of no length.
double scaled_jacobian(const HexMesh& mesh, const Hexahedron& hexahedron);

}  // namespace ostia::geometry
