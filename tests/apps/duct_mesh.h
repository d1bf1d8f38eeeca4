#pragma once
/// \file A small volume mesh for the commands about solvers' cases.

#include "ostia/geometry/mixed_mesh.h"
#include "ostia/geometry/mixed_mesh_sides.h"

namespace ostia::testing {

/// A duct of 3 x 3 x 4 mm in cubes of six tetrahedra, along z from its inlet to its outlet.
inline geometry::MixedMesh duct() {
  constexpr int nx = 3, nz = 4;
  geometry::MixedMesh mesh;
  const auto at = [](int i, int j, int k) { return (k * (nx + 1) + j) * (nx + 1) + i; };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= nx; ++j)
      for (int i = 0; i <= nx; ++i) mesh.points.emplace_back(i, j, k);
  constexpr int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < nx; ++j)
      for (int i = 0; i < nx; ++i)
        for (int w = 0; w < 6; ++w) {  // from one corner of the cube to the opposite one, axis by axis
          int p[3] = {i, j, k};
          geometry::Tetrahedron t = {at(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++p[ways[w][s]];
            t[s + 1] = at(p[0], p[1], p[2]);
          }
          if (w >= 3) std::swap(t[1], t[2]);
          mesh.tetrahedra.push_back(t);
        }
  geometry::take_free_sides_as_boundary(mesh);
  mesh.faces = {{1, "wall", geometry::FaceKind::wall},
                {2, "inlet_a", geometry::FaceKind::inlet},
                {3, "outlet_a", geometry::FaceKind::outlet}};
  for (std::size_t f = 0; f < mesh.triangles.size(); ++f) {
    double z = 0.0;
    for (const std::int32_t p : mesh.triangles[f]) z += mesh.points[static_cast<std::size_t>(p)].z();
    mesh.triangle_face_ids[f] = z == 0.0 ? 2 : z == 3.0 * nz ? 3 : 1;
  }
  return mesh;
}

}  // namespace ostia::testing
