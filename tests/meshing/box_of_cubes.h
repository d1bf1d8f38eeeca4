#pragma once
/// \file A box of tetrahedra, as many as are wanted.

#include "ostia/geometry/vec.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace ostia::meshing {

/// n^3 cubes of 1 mm from the origin, each of six tetrahedra around its diagonal; a VolumeMesh or a MixedMesh
/// without its boundary.
template <class Mesh>
Mesh box_of_cubes(std::int32_t n) {
  Mesh mesh;
  const std::int32_t m = n + 1;
  for (std::int32_t k = 0; k < m; ++k)
    for (std::int32_t j = 0; j < m; ++j)
      for (std::int32_t i = 0; i < m; ++i) mesh.points.emplace_back(i, j, k);
  const std::array<std::int32_t, 3> step{1, m, m * m};
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    for (std::int32_t k = 0; k < n; ++k)
      for (std::int32_t j = 0; j < n; ++j)
        for (std::int32_t i = 0; i < n; ++i) {
          const std::int32_t a = i + m * (j + m * k), b = a + step[axes[0]], c = b + step[axes[1]],
                             d = c + step[axes[2]];
          if (axes[0] == (axes[2] + 1) % 3)
            mesh.tetrahedra.push_back({a, b, c, d});
          else
            mesh.tetrahedra.push_back({a, c, b, d});
        }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return mesh;
}

}  // namespace ostia::meshing
