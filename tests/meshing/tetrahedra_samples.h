#pragma once
/// \file Small tetrahedral meshes for the tests of mending, and what must hold after it.

#include "box_of_cubes.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <map>
#include <random>
#include <utility>

namespace ostia::meshing {

/// The outer faces of the tetrahedra become the boundary, outward, of face 1.
inline void take_boundary(geometry::VolumeMesh& mesh) {
  std::map<std::array<std::int32_t, 3>, std::pair<int, geometry::Triangle>> faces;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra)
    for (const geometry::Triangle& f :
         {geometry::Triangle{t[1], t[2], t[3]}, {t[0], t[3], t[2]}, {t[0], t[1], t[3]}, {t[0], t[2], t[1]}}) {
      std::array<std::int32_t, 3> key = f;
      std::sort(key.begin(), key.end());
      auto& [count, face] = faces[key];
      ++count;
      face = f;
    }
  mesh.boundary.clear();
  for (const auto& [key, face] : faces)
    if (face.first == 1) mesh.boundary.push_back(face.second);
  mesh.boundary_face_ids.assign(mesh.boundary.size(), 1);
}

/// The sign of the volume is beyond doubt: it is larger than all rounding of long doubles together.
inline bool surely_positive(const geometry::VolumeMesh& mesh, const geometry::Tetrahedron& t) {
  using Long = std::array<long double, 3>;
  std::array<Long, 3> e{};
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t k = 0; k < 3; ++k)
      e[i][k] =
          static_cast<long double>(mesh.points[static_cast<std::size_t>(t[i + 1])][static_cast<int>(k)]) -
          static_cast<long double>(mesh.points[static_cast<std::size_t>(t[0])][static_cast<int>(k)]);
  long double determinant = 0.0L, magnitude = 0.0L;
  for (std::size_t k = 0; k < 3; ++k) {
    const long double one = e[0][k] * e[1][(k + 1) % 3] * e[2][(k + 2) % 3],
                      other = e[0][k] * e[1][(k + 2) % 3] * e[2][(k + 1) % 3];
    determinant += one - other;
    magnitude += std::fabs(one) + std::fabs(other);
  }
  return determinant > 64.0L * std::numeric_limits<long double>::epsilon() * magnitude;
}

/// Conforming, nothing inverted beyond doubt, the same volume, the same boundary bit for bit.
inline void expect_sound(const geometry::VolumeMesh& mesh, const geometry::VolumeMesh& old) {
  EXPECT_EQ(mesh.boundary_face_ids, old.boundary_face_ids);
  ASSERT_EQ(mesh.boundary.size(), old.boundary.size());
  for (std::size_t i = 0; i < mesh.boundary.size(); ++i)
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_EQ(mesh.points[static_cast<std::size_t>(mesh.boundary[i][k])],
                old.points[static_cast<std::size_t>(old.boundary[i][k])]);
  std::map<std::array<std::int32_t, 3>, int> uses;
  std::size_t inverted = 0, wrong = 0;
  for (const geometry::Tetrahedron& t : mesh.tetrahedra) {
    inverted += surely_positive(mesh, t) ? 0 : 1;
    for (std::size_t i = 0; i < 4; ++i) {
      std::array<std::int32_t, 3> key{t[(i + 1) % 4], t[(i + 2) % 4], t[(i + 3) % 4]};
      std::sort(key.begin(), key.end());
      ++uses[key];
    }
  }
  for (const geometry::Triangle& t : mesh.boundary) {
    std::array<std::int32_t, 3> key = t;
    std::sort(key.begin(), key.end());
    wrong += uses[key] == 1 ? 0 : 1;
    uses[key] = 2;
  }
  for (const auto& [key, count] : uses) wrong += count == 2 ? 0 : 1;
  EXPECT_EQ(inverted, 0u);
  EXPECT_EQ(wrong, 0u);
  EXPECT_NEAR(geometry::volume(mesh), geometry::volume(old), 1e-12 * geometry::volume(old));
}

/// Two triangles that meet in a flat roof's ridge, a flat tetrahedron right below them, and below that two
/// points so that all is filled. The ridge is 0-1; the tetrahedron's other edge, 2-3, lies just below it.
inline geometry::VolumeMesh flat_tetrahedron_under_a_roof() {
  geometry::VolumeMesh mesh;
  mesh.points = {{-1, 0, 0.05}, {1, 0, 0.05}, {0, -1, 0}, {0, 1, 0}, {-0.7, 0, -1.2}, {0.7, 0, -1.2}};
  // Below 2-3: the triangles 2-3-0 and 2-3-1 with 4 and 5, and what is between these two points.
  mesh.tetrahedra = {{0, 1, 3, 2}, {2, 0, 3, 4}, {2, 3, 1, 5}, {2, 3, 5, 4}};
  for (geometry::Tetrahedron& t : mesh.tetrahedra) {
    const auto p = [&](std::size_t i) { return mesh.points[static_cast<std::size_t>(t[i])]; };
    if ((p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) < 0.0) std::swap(t[2], t[3]);
  }
  take_boundary(mesh);
  return mesh;
}

/// A box of n^3 cubes with its inner points moved at random as far as no tetrahedron is inverted.
inline geometry::VolumeMesh random_box(std::int32_t n, unsigned seed) {
  auto mesh = box_of_cubes<geometry::VolumeMesh>(n);
  take_boundary(mesh);
  std::vector<std::vector<std::size_t>> around(mesh.points.size());
  for (std::size_t t = 0; t < mesh.tetrahedra.size(); ++t)
    for (const std::int32_t v : mesh.tetrahedra[t]) around[static_cast<std::size_t>(v)].push_back(t);
  const auto thin = [&](std::size_t t) {
    const auto p = [&](std::size_t i) {
      return mesh.points[static_cast<std::size_t>(mesh.tetrahedra[t][i])];
    };
    return (p(1) - p(0)).cross(p(2) - p(0)).dot(p(3) - p(0)) < 0.02;
  };
  std::mt19937 random(seed);
  const auto next = [&] { return 1.2 * (static_cast<double>(random()) / 4294967295.0 - 0.5); };
  for (std::size_t v = 0; v < mesh.points.size(); ++v) {
    const geometry::Vec3 old = mesh.points[v];
    const bool inner = (old.array() > 0.5).all() && (old.array() < n - 0.5).all();
    if (!inner) continue;
    const double x = next(), y = next(), z = next();
    mesh.points[v] = old + geometry::Vec3(x, y, z);
    if (std::any_of(around[v].begin(), around[v].end(), thin)) mesh.points[v] = old;
  }
  return mesh;
}

}  // namespace ostia::meshing
