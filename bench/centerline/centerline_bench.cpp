// Centerlines of a coronary-like tree with five ends, from an exact and from a raw marching-cubes surface.

#include "skeleton_bench.h"

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

void centerlines(benchmark::State& state, double spacing_mm, bool raw) {
  run(state, raw ? geometry::raw_surface_of(tree(), spacing_mm, true)
                 : geometry::surface_of(tree(), spacing_mm, true));
}

void add(const char* name, double spacing_mm, bool raw) {
  benchmark::RegisterBenchmark(name, centerlines, spacing_mm, raw)
      ->Unit(benchmark::kMillisecond)
      ->MeasureProcessCPUTime()
      ->UseRealTime();
}

}  // namespace

int main(int argc, char** argv) {
  add("centerlines of a coronary-like tree, 15k triangles, 5 ends", 0.5, false);
  add("centerlines of a coronary-like tree, 59k triangles, 5 ends", 0.2525, false);
  add("centerlines of a coronary-like tree, 255k triangles, 5 ends", 0.1216, false);
  add("centerlines of a raw marching-cubes surface, 59k triangles, 5 ends", 0.2525, true);
  add("centerlines of a raw marching-cubes surface, 255k triangles, 5 ends", 0.1216, true);
  add_skeleton_benchmarks();
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
