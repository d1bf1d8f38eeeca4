#include "ostia/geometry/hex_mesh.h"

#include <algorithm>

namespace ostia::geometry {

namespace {

const Vec3& corner(const HexMesh& mesh, const Hexahedron& hexahedron, int place) {
  return mesh.points[static_cast<std::size_t>(hexahedron[static_cast<std::size_t>(place)])];
}

}  // namespace

double volume(const HexMesh& mesh, const Hexahedron& hexahedron) {
  // Around the diagonal from 0 to 6: the other six corners as a ring.
  constexpr std::array<int, 6> ring = {1, 2, 3, 7, 4, 5};
  const Vec3 &first = corner(mesh, hexahedron, 0), diagonal = corner(mesh, hexahedron, 6);
  double six = 0.0;
  for (std::size_t k = 0; k < ring.size(); ++k) {
    const Vec3 a = corner(mesh, hexahedron, ring[k]) - first,
               b = corner(mesh, hexahedron, ring[(k + 1) % ring.size()]) - first;
    six += a.cross(b).dot(diagonal - first);
  }
  return six / 6.0;
}

double scaled_jacobian(const HexMesh& mesh, const Hexahedron& hexahedron) {
  // Of each corner its neighbours, such that a box has a positive triple product.
  constexpr std::array<std::array<int, 3>, 8> neighbours = {
      {{1, 3, 4}, {2, 0, 5}, {3, 1, 6}, {0, 2, 7}, {7, 5, 0}, {4, 6, 1}, {5, 7, 2}, {6, 4, 3}}};
  double least = 1.0;
  for (int k = 0; k < 8; ++k) {
    const Vec3& here = corner(mesh, hexahedron, k);
    const auto& around = neighbours[static_cast<std::size_t>(k)];
    const Vec3 a = corner(mesh, hexahedron, around[0]) - here, b = corner(mesh, hexahedron, around[1]) - here,
               c = corner(mesh, hexahedron, around[2]) - here;
    const double lengths = a.norm() * b.norm() * c.norm();
    least = std::min(least, lengths > 0.0 ? a.cross(b).dot(c) / lengths : -1.0);
  }
  return least;
}

}  // namespace ostia::geometry
