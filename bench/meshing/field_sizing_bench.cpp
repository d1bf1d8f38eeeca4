// Lengths from a jet's velocity on a million tetrahedra.
#include "box_of_cubes.h"

#include "ostia/meshing/field_sizing.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace ostia::meshing {
namespace {

void sizes_of_a_million(benchmark::State& state, bool by_elements) {
  constexpr std::int32_t cubes = 55;
  auto mesh = box_of_cubes<geometry::MixedMesh>(cubes);
  for (geometry::Vec3& p : mesh.points) p /= cubes;
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
