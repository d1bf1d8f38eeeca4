#pragma once
/// \file Small exact shapes for the tests of pictures.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cmath>
#include <numbers>

namespace ostia::figure {

/// A ball with vertices on the sphere, outward; closed but for its poles, where the vertices coincide.
inline geometry::TriMesh ball(double radius, int rings = 64,
                              const geometry::Vec3& centre = geometry::Vec3::Zero()) {
  geometry::TriMesh mesh;
  const int around = 2 * rings;
  for (int i = 0; i <= rings; ++i) {
    const double polar = std::numbers::pi * i / rings;
    for (int j = 0; j < around; ++j) {
      const double angle = 2.0 * std::numbers::pi * j / around;
      mesh.points.push_back(centre + radius * geometry::Vec3(std::sin(polar) * std::cos(angle),
                                                             std::sin(polar) * std::sin(angle),
                                                             std::cos(polar)));
    }
  }
  for (int i = 0; i < rings; ++i) {
    for (int j = 0; j < around; ++j) {
      const int a = i * around + j;
      const int b = i * around + (j + 1) % around;
      if (i > 0) mesh.triangles.push_back({a, a + around, b});
      if (i + 1 < rings) mesh.triangles.push_back({b, a + around, b + around});
    }
  }
  return mesh;
}

/// A rectangle in the plane y = `y`, seen from the front.
inline geometry::TriMesh sheet(double half_width, double half_height, double y = 0.0) {
  geometry::TriMesh mesh;
  mesh.points = {{-half_width, y, -half_height},
                 {half_width, y, -half_height},
                 {half_width, y, half_height},
                 {-half_width, y, half_height}};
  mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
  return mesh;
}

/// A box of nx x ny x nz unit cubes from the origin, six tetrahedra each.
inline geometry::MixedMesh tetrahedral_box(int nx, int ny, int nz) {
  geometry::MixedMesh mesh;
  const auto id = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k) {
    for (int j = 0; j <= ny; ++j) {
      for (int i = 0; i <= nx; ++i) mesh.points.emplace_back(i, j, k);
    }
  }
  constexpr std::array<std::array<std::size_t, 4>, 6> kTetrahedra{
      {{0, 1, 3, 7}, {0, 3, 2, 7}, {0, 2, 6, 7}, {0, 6, 4, 7}, {0, 4, 5, 7}, {0, 5, 1, 7}}};
  for (int k = 0; k < nz; ++k) {
    for (int j = 0; j < ny; ++j) {
      for (int i = 0; i < nx; ++i) {
        std::array<int, 8> corner{};
        for (int c = 0; c < 8; ++c) {
          corner[static_cast<std::size_t>(c)] = id(i + (c & 1), j + ((c >> 1) & 1), k + ((c >> 2) & 1));
        }
        for (const auto& t : kTetrahedra)
          mesh.tetrahedra.push_back({corner[t[0]], corner[t[1]], corner[t[2]], corner[t[3]]});
      }
    }
  }
  return mesh;
}

}  // namespace ostia::figure
