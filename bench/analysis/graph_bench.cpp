// Trees of a million segments: grown, measured, and searched for overlaps.

#include "growth_stubs.h"

#include "ostia/analysis/graph_overlaps.h"
#include "ostia/analysis/graph_report.h"
#include "ostia/analysis/tree_growth.h"
#include "ostia/core/parallel.h"

#include <benchmark/benchmark.h>

namespace {

using namespace ostia;
using analysis::testing::stubs;

constexpr double order_8 = 0.231;  // radius, mm

/// The argument of all: how many ends grow; 181 make 1.4 million segments.
void grow_tree(benchmark::State& state) {
  const geometry::VesselGraph scanned = stubs(static_cast<int>(state.range(0)), order_8);
  analysis::GrownTree tree;
  for (auto _ : state) tree = analysis::grow_tree(scanned, analysis::domain_of(analysis::MyocardialShell{}));
  state.counters["segments"] = static_cast<double>(tree.graph.edges.size());
  state.counters["elements"] = static_cast<double>(tree.elements);
  state.counters["left_out"] = static_cast<double>(tree.elements_left_out);
}
BENCHMARK(grow_tree)->Arg(6)->Arg(181)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void measure_tree(benchmark::State& state) {
  const analysis::GrownTree tree = analysis::grow_tree(stubs(static_cast<int>(state.range(0)), order_8),
                                                       analysis::domain_of(analysis::MyocardialShell{}));
  for (auto _ : state) benchmark::DoNotOptimize(analysis::measure_tree(tree.graph));
  state.counters["segments"] = static_cast<double>(tree.graph.edges.size());
}
BENCHMARK(measure_tree)->Arg(6)->Arg(181)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void find_overlaps(benchmark::State& state) {
  const analysis::GrownTree tree = analysis::grow_tree(stubs(static_cast<int>(state.range(0)), order_8),
                                                       analysis::domain_of(analysis::MyocardialShell{}));
  core::set_max_threads(2);
  std::size_t found = 0;
  for (auto _ : state)
    found = analysis::find_overlaps(tree.graph, geometry::GraphIncidence(tree.graph)).size();
  core::set_max_threads(0);
  state.counters["segments"] = static_cast<double>(tree.graph.edges.size());
  state.counters["found"] = static_cast<double>(found);
}
BENCHMARK(find_overlaps)->Arg(6)->Arg(181)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
