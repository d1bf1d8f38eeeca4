// A template of 10,462 points brought onto the tree at another phase, depth 4.

#include "moved_tree.h"

#include "ostia/motion/cage_descent.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

using motion::testing::target_tree;

const geometry::TriMesh& template_tree() {
  static const geometry::TriMesh mesh = motion::testing::template_tree();
  return mesh;
}

void tell(benchmark::State& state, const motion::Registration& r, const geometry::TriMesh& target,
          double amount) {
  const motion::testing::Error e = motion::testing::vertex_error(template_tree(), r.surface, amount);
  state.counters["points"] = static_cast<double>(template_tree().points.size());
  state.counters["distance_mm"] = motion::testing::target_distance(target, r.surface);
  state.counters["error_mm"] = e.mean;
  state.counters["worst_mm"] = e.worst;
  state.counters["rounds"] = r.report.rounds;
  state.counters["least_jacobian"] = r.report.least_jacobian;
  state.counters["intersections"] = static_cast<double>(r.report.self_intersections);
}

/// The argument: the motion, in per cent of 13.2 mm at the farthest.
template <class Method>
void run(benchmark::State& state, const Method& method) {
  const double amount = static_cast<double>(state.range(0)) / 100.0;
  const geometry::TriMesh target = target_tree(amount);
  motion::Registration r;
  for (auto _ : state) {
    r = method(target);
    benchmark::DoNotOptimize(r.surface.points.data());
  }
  tell(state, r, target, amount);
}
void motions(benchmark::internal::Benchmark* bench) {
  bench->Arg(25)->Arg(50)->Arg(75)->Arg(100);
  bench->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();
}

void register_cage(benchmark::State& state) {
  run(state, [](const geometry::TriMesh& target) { return motion::register_cage(template_tree(), target); });
}
BENCHMARK(register_cage)->Apply(motions);

void register_cage_by_descent(benchmark::State& state) {
  run(state, [](const geometry::TriMesh& target) {
    return motion::register_cage_by_descent(template_tree(), target);
  });
}
BENCHMARK(register_cage_by_descent)->Apply(motions);

}  // namespace

BENCHMARK_MAIN();
