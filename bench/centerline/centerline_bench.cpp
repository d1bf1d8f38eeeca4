// Centerlines of a coronary-like tree with five ends, from an exact and from a raw marching-cubes surface.

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/analytic_shapes.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

const geometry::AnalyticShape& tree() {
  static const geometry::AnalyticShape shape = geometry::coronary_like_tree();
  return shape;
}

void report(benchmark::State& state, const geometry::TriMesh& surface,
            const centerline::CenterlineResult& result) {
  state.counters["triangles"] = static_cast<double>(surface.triangles.size());
  state.counters["ends"] = static_cast<double>(result.lines.size() + 1);
  state.counters["cells"] = static_cast<double>(result.diagnostics.delaunay_cells);
  state.counters["doubtful"] = static_cast<double>(result.diagnostics.doubtful_cells);
  state.counters["dropped"] = static_cast<double>(result.diagnostics.dropped_points);
}

void run(benchmark::State& state, const geometry::TriMesh& surface) {
  core::set_max_threads(2);
  centerline::CenterlineResult result;
  for (auto _ : state) {
    result = centerline::extract_centerlines(surface, std::nullopt, {});
    benchmark::DoNotOptimize(result);
  }
  report(state, surface, result);
  core::set_max_threads(0);
}

// The argument is the grid's spacing in micrometres.
void centerlines_of_exact_surface(benchmark::State& state) {
  run(state, geometry::surface_of(tree(), 1e-3 * static_cast<double>(state.range(0)), true));
}
BENCHMARK(centerlines_of_exact_surface)
    ->Arg(500)
    ->Arg(250)
    ->Arg(125)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

void centerlines_of_raw_surface(benchmark::State& state) {
  run(state, geometry::raw_surface_of(tree(), 1e-3 * static_cast<double>(state.range(0)), true));
}
BENCHMARK(centerlines_of_raw_surface)
    ->Arg(250)
    ->Arg(125)
    ->Unit(benchmark::kMillisecond)
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
