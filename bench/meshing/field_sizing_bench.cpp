// Lengths from a jet's velocity on a million tetrahedra.
#include "ostia/meshing/field_sizing.h"

#include <benchmark/benchmark.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::meshing {
namespace {

/// n^3 cubes of 1/n mm, each of six tetrahedra around its diagonal.
geometry::MixedMesh box(std::int32_t n) {
  geometry::MixedMesh mesh;
  const std::int32_t m = n + 1;
  for (std::int32_t k = 0; k < m; ++k)
    for (std::int32_t j = 0; j < m; ++j)
      for (std::int32_t i = 0; i < m; ++i) mesh.points.emplace_back(geometry::Vec3(i, j, k) / n);
  const std::array<std::int32_t, 3> step{1, m, m * m};
  std::array<std::size_t, 3> axes{0, 1, 2};
  do {
    for (std::int32_t k = 0; k < n; ++k)
      for (std::int32_t j = 0; j < n; ++j)
        for (std::int32_t i = 0; i < n; ++i) {
          const std::int32_t a = i + m * (j + m * k), b = a + step[axes[0]], c = b + step[axes[1]],
                             d = c + step[axes[2]];
          const bool even = axes[0] == (axes[2] + 1) % 3;
          mesh.tetrahedra.push_back(even ? geometry::Tetrahedron{a, b, c, d}
                                         : geometry::Tetrahedron{a, c, b, d});
        }
  } while (std::next_permutation(axes.begin(), axes.end()));
  return mesh;
}

void sizes_of_a_million(benchmark::State& state, bool by_elements) {
  constexpr std::int32_t cubes = 55;
  const geometry::MixedMesh mesh = box(cubes);
  MeshField velocity;
  velocity.components = 3;
  for (const geometry::Vec3& p : mesh.points) {
    const double r = std::hypot(p.x() - 0.5, p.y() - 0.5);
    for (const double v : {0.0, 0.01 * p.x(), 0.5 - 0.5 * std::tanh((r - 0.2) / 0.05)})
      velocity.values.push_back(v);
  }
  FieldSizingOptions options;
  options.error_share = 5e-4;
  if (by_elements) options.elements = 2.0 * static_cast<double>(mesh.tetrahedra.size());
  FieldSizing made;
  for (auto _ : state) made = sizes_from_field(mesh, velocity, options);
  state.counters["tetrahedra"] = static_cast<double>(mesh.tetrahedra.size());
  state.counters["foretold"] = made.elements;
  state.counters["refined_share"] = made.refined_share;
}

}  // namespace

BENCHMARK_CAPTURE(sizes_of_a_million, 0, false)
    ->Name("sizes from a velocity on 1M tetrahedra")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);
BENCHMARK_CAPTURE(sizes_of_a_million, 1, true)
    ->Name("sizes from a velocity on 1M tetrahedra, for 2M elements")
    ->Unit(benchmark::kSecond)
    ->UseRealTime()
    ->Iterations(1);

}  // namespace ostia::meshing
