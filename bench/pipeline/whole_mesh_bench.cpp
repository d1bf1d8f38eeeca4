// From a surface to a finished, judged mesh of two million quadratic tetrahedra with layers of prisms: axes,
// cut ends, caps, remeshing, layers, TetGen in its child process, second order, quality.

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/pipeline/model.h"

#include <benchmark/benchmark.h>
#include <sys/resource.h>

#include <cstdio>
#include <cstdlib>
#include <ctime>

namespace {

using namespace ostia;

double cpu_seconds() {
  double seconds = 0.0;
  for (const int who : {RUSAGE_SELF, RUSAGE_CHILDREN}) {
    rusage usage{};
    ::getrusage(who, &usage);
    for (const timeval& time : {usage.ru_utime, usage.ru_stime})
      seconds += static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
  }
  return seconds;
}

double peak_mb(int who) {
  rusage usage{};
  ::getrusage(who, &usage);
  return static_cast<double>(usage.ru_maxrss) / 1024.0;
}

/// Edges that give the coronary-like tree two million tetrahedra; another ratio by OSTIA_BENCH_EDGE_RATIO.
double edge_ratio() {
  const char* given = std::getenv("OSTIA_BENCH_EDGE_RATIO");
  return given ? std::atof(given) : 0.127;
}

void surface_to_two_million(benchmark::State& state) {
  const geometry::TriMesh surface = geometry::raw_surface_of(geometry::coronary_like_tree(), 0.25, true);
  pipeline::ModelOptions options;
  options.sizing.edge_ratio = edge_ratio();
  options.volume.layers.emplace();
  options.volume.layers->layers = 3;
  options.volume.layers->thickness = 1.0;
  options.volume.order = 2;
  const double before = cpu_seconds();
  pipeline::MeshedLumen meshed;
  for (auto _ : state) {
    const auto axes = centerline::extract_centerlines(surface, std::nullopt, {}, options.centerline);
    meshed = pipeline::mesh_lumen(surface, axes.tree, options);
  }
  for (const pipeline::StageTime& stage : meshed.stages)
    std::fprintf(stderr, "%-32s %7.2f s\n", stage.name.c_str(), stage.seconds);
  std::fprintf(stderr, "%s\n",
               meshed.quality.verdict.ok() ? "passed" : meshed.quality.verdict.summary().c_str());
  state.counters["triangles_in"] = static_cast<double>(surface.triangles.size());
  state.counters["tetrahedra"] = static_cast<double>(meshed.mesh.tetrahedra.size());
  state.counters["prisms"] = static_cast<double>(meshed.mesh.prisms.size());
  state.counters["points"] = static_cast<double>(meshed.mesh.points.size());
  state.counters["passed"] = meshed.quality.verdict.ok() ? 1.0 : 0.0;
  state.counters["cpu_s"] = cpu_seconds() - before;  // the child's too
  state.counters["peak_mb"] = peak_mb(RUSAGE_SELF);
  state.counters["child_peak_mb"] = peak_mb(RUSAGE_CHILDREN);
}
BENCHMARK(surface_to_two_million)
    ->Name("surface to a mesh of 2M quadratic tetrahedra with layers")
    ->Unit(benchmark::kSecond)
    ->Iterations(1)
    ->UseRealTime();

}  // namespace
