// Trees of a million segments: grown, measured, and searched for overlaps.

#include "ostia/analysis/graph_overlaps.h"
#include "ostia/analysis/graph_report.h"
#include "ostia/analysis/tree_growth.h"
#include "ostia/core/parallel.h"

#include <benchmark/benchmark.h>

#include <cmath>

namespace {

using namespace ostia;

/// Short vessels of order 8 on the outer surface of the default shell, spread about it.
geometry::VesselGraph stubs(int count) {
  geometry::VesselGraph graph;
  for (int i = 0; i < count; ++i) {
    const double phi = i * 2.399963, z = 8.0 + 65.0 * (i + 0.5) / count;
    const double r = 40.0 * std::sqrt(1.0 - z * z / 8100.0);
    for (const double scale : {1.05, 0.97})
      graph.points.emplace_back(scale * r * std::cos(phi), scale * r * std::sin(phi), z);
    graph.edges.push_back({2 * i, 2 * i + 1, 0.231, 0.231});
  }
  return graph;
}

/// The argument of all: how many ends grow; 181 make 1.4 million segments.
void grow_tree(benchmark::State& state) {
  const geometry::VesselGraph scanned = stubs(static_cast<int>(state.range(0)));
  analysis::GrownTree tree;
  for (auto _ : state) tree = analysis::grow_tree(scanned, analysis::domain_of(analysis::MyocardialShell{}));
  state.counters["segments"] = static_cast<double>(tree.graph.edges.size());
  state.counters["elements"] = static_cast<double>(tree.elements);
  state.counters["left_out"] = static_cast<double>(tree.elements_left_out);
}
BENCHMARK(grow_tree)->Arg(6)->Arg(181)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void measure_tree(benchmark::State& state) {
  const analysis::GrownTree tree = analysis::grow_tree(stubs(static_cast<int>(state.range(0))),
                                                       analysis::domain_of(analysis::MyocardialShell{}));
  for (auto _ : state) benchmark::DoNotOptimize(analysis::measure_tree(tree.graph));
  state.counters["segments"] = static_cast<double>(tree.graph.edges.size());
}
BENCHMARK(measure_tree)->Arg(6)->Arg(181)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

void find_overlaps(benchmark::State& state) {
  const analysis::GrownTree tree = analysis::grow_tree(stubs(static_cast<int>(state.range(0))),
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
