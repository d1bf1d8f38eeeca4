// How sure pressures are: 1,000 trees of ten vessels (the bar: 2 s on two cores), with and without the
// question of where it comes from.

#include "ten_vessels.h"

#include "ostia/hemodynamics/uncertainty.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;

void draw_trees(benchmark::State& state, bool indices) {
  const hemodynamics::Network network = bench::ten_vessels();
  const std::vector<hemodynamics::LesionPlace> lesions = {{"S1", {1, 7.5}, {1, 12.5}, {1, 17.5}}};
  hemodynamics::UncertaintyOptions options;
  options.indices = indices;
  hemodynamics::FlowModel model;
  model.from_rest = true;
  hemodynamics::PressureUncertainty found;
  for (auto _ : state) found = hemodynamics::pressure_uncertainty(network, {}, lesions, model, {}, options);
  state.counters["trees"] = found.trees;
  state.counters["failed"] = found.failed;
}
void thousand_trees(benchmark::State& state) {
  draw_trees(state, false);
}
BENCHMARK(thousand_trees)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

void thousand_trees_with_indices(benchmark::State& state) {
  draw_trees(state, true);
}
BENCHMARK(thousand_trees_with_indices)->Unit(benchmark::kMillisecond)->UseRealTime()->MeasureProcessCPUTime();

}  // namespace
