// The tree of bench_motion by the methods that the cage is compared with: 4,913 control points, run until
// they converge.

#include "moved_tree.h"

#include "ostia/experiments/mixture_deformation.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

/// The arguments: kind, cost, and the motion in per cent of 13.2 mm at the farthest.
void deform_by_mixtures(benchmark::State& state) {
  experiments::MixtureOptions options;
  options.kind = static_cast<experiments::DeformationKind>(state.range(0));
  options.cost = static_cast<experiments::MixtureCost>(state.range(1));
  const double amount = static_cast<double>(state.range(2)) / 100.0;
  const geometry::TriMesh source = motion::testing::template_tree(),
                          target = motion::testing::target_tree(amount);
  experiments::MixtureDeformation r;
  for (auto _ : state) {
    r = experiments::deform_by_mixtures(source, target, options);
    benchmark::DoNotOptimize(r.surface.points.data());
  }
  const motion::testing::Error e = motion::testing::vertex_error(source, r.surface, amount);
  state.counters["points"] = static_cast<double>(source.points.size());
  state.counters["distance_mm"] = motion::testing::target_distance(target, r.surface);
  state.counters["error_mm"] = e.mean;
  state.counters["worst_mm"] = e.worst;
  state.counters["iterations"] = r.report.iterations;
  state.counters["converged"] = r.report.converged ? 1.0 : 0.0;
}
BENCHMARK(deform_by_mixtures)
    ->ArgsProduct({{0, 1}, {0, 1}, {25, 100}})
    ->Iterations(1)
    ->Unit(benchmark::kMillisecond)
    ->UseRealTime()
    ->MeasureProcessCPUTime();

}  // namespace

BENCHMARK_MAIN();
