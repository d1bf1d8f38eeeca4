#pragma once
/// \file Volume meshes of which every count is known.

#include "ostia/geometry/mixed_mesh.h"

#include <memory>

namespace ostia::view::testing {

/// A box of nx x ny x nz cubes of `size` mm from the origin, each of six tetrahedra about its diagonal
/// (Kuhn); the elements of a cube stand together, cubes of one z after those of the one below.
inline std::shared_ptr<const geometry::MixedMesh> grid_of_cubes(std::int32_t nx, std::int32_t ny,
                                                                std::int32_t nz, double size = 1.0) {
  auto mesh = std::make_shared<geometry::MixedMesh>();
  const auto at = [&](std::int32_t i, std::int32_t j, std::int32_t k) {
    return (k * (ny + 1) + j) * (nx + 1) + i;
  };
  for (std::int32_t k = 0; k <= nz; ++k)
    for (std::int32_t j = 0; j <= ny; ++j)
      for (std::int32_t i = 0; i <= nx; ++i) mesh->points.push_back(size * geometry::Vec3(i, j, k));
  constexpr std::array<std::array<int, 3>, 6> ways{
      {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}}};
  for (std::int32_t k = 0; k < nz; ++k)
    for (std::int32_t j = 0; j < ny; ++j)
      for (std::int32_t i = 0; i < nx; ++i)
        for (std::size_t w = 0; w < ways.size(); ++w) {
          std::array<std::int32_t, 3> step{i, j, k};
          geometry::Tetrahedron t{at(i, j, k), 0, 0, 0};
          for (std::size_t s = 0; s < 3; ++s) {
            ++step[static_cast<std::size_t>(ways[w][s])];
            t[s + 1] = at(step[0], step[1], step[2]);
          }
          if (w >= 3) std::swap(t[1], t[2]);  // the odd ones run the other way
          mesh->tetrahedra.push_back(t);
        }
  return mesh;
}

}  // namespace ostia::view::testing
