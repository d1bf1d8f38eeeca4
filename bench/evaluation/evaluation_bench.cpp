// How long it takes to judge: distances between two surfaces of 200,000 triangles each.

#include "ostia/core/parallel.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/analytic_shapes.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace ostia;

/// A coronary-like tree and the same tree bent and moved a little, as a segmentation of it would lie.
struct Pair {
  geometry::TriMesh reference, result;
};

const Pair& trees() {
  static const Pair pair = [] {
    const geometry::AnalyticShape shape = geometry::coronary_like_tree();
    Pair out{geometry::surface_of(shape, 0.137, true), geometry::surface_of(shape, 0.1371, true)};
    for (geometry::Vec3& p : out.result.points)
      p += geometry::Vec3(0.1 * std::sin(0.7 * p.z()), 0.1 * std::cos(0.5 * p.x()), 0.05);
    return out;
  }();
  return pair;
}

void surface_distance(benchmark::State& state) {
  const Pair& pair = trees();  // made before the clock runs
  core::set_max_threads(2);
  evaluation::SurfaceDistances d;
  for (auto _ : state) {
    d = evaluation::compare_surfaces(pair.reference, pair.result);
    benchmark::DoNotOptimize(d);
  }
  state.counters["triangles"] = static_cast<double>(pair.reference.triangles.size());
  state.counters["msd_mm"] = d.msd_mm;
  core::set_max_threads(0);
}

}  // namespace

int main(int argc, char** argv) {
  benchmark::RegisterBenchmark("surface_distance/200k", surface_distance)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
