// The surface of a grown tree of 2,000 branches, on two cores.

#include "ostia/analysis/tree_growth.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/reconstruction/surface.h"

#include <benchmark/benchmark.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <utility>

namespace {

using namespace ostia;

/// One vessel of order 8 on the outer surface of the default shell, and what grows behind it.
geometry::VesselGraph grown() {
  geometry::VesselGraph stub;
  stub.points = {{42.0, 0.0, 8.0}, {38.8, 0.0, 8.0}};
  stub.edges = {{0, 1, 0.231, 0.231}};
  return analysis::grow_tree(stub, analysis::domain_of(analysis::MyocardialShell{})).graph;
}

/// The branches nearest to the root, by the number of forks; every fork that is kept is kept whole.
geometry::VesselGraph first_branches(const geometry::VesselGraph& whole, std::size_t most) {
  const geometry::GraphIncidence incidence(whole);
  geometry::VesselGraph kept;
  kept.points.push_back(whole.points[0]);
  std::deque<std::pair<std::int32_t, std::int32_t>> open{{0, 0}};  // a point's index in either graph
  std::size_t branches = 1;
  while (!open.empty()) {
    const auto [from, own] = open.front();
    open.pop_front();
    const auto leaving = incidence.leaving(from);
    if (leaving.size() > 1 && branches + leaving.size() > most) continue;
    if (leaving.size() > 1) branches += leaving.size();
    for (const std::int32_t index : leaving) {
      geometry::GraphEdge edge = whole.edges[static_cast<std::size_t>(index)];
      const auto added = static_cast<std::int32_t>(kept.points.size());
      kept.points.push_back(whole.points[static_cast<std::size_t>(edge.to)]);
      open.emplace_back(edge.to, added);
      edge.from = own;
      edge.to = added;
      kept.edges.push_back(edge);
    }
  }
  return kept;
}

/// How many pairs of triangles cross whose branches are one or share a fork; the others are two vessels that
/// meet elsewhere.
std::size_t crossings_at_forks(const geometry::VesselGraph& tree,
                               const reconstruction::ReconstructedSurface& made) {
  const auto branches = geometry::branches(tree, geometry::GraphIncidence(tree));
  const auto ends = [&](std::int32_t triangle) {
    const auto branch = static_cast<std::size_t>(made.branch_of_quad[static_cast<std::size_t>(triangle / 2)]);
    const auto& edges = branches[branch].edges;
    return std::pair{tree.edges[static_cast<std::size_t>(edges.front())].from,
                     tree.edges[static_cast<std::size_t>(edges.back())].to};
  };
  std::size_t count = 0;
  for (const auto& [one, other] : geometry::self_intersections(made.surface.mesh)) {
    const auto a = ends(one), b = ends(other);
    if (a.first == b.first || a.first == b.second || a.second == b.first || a.second == b.second) ++count;
  }
  return count;
}

/// Branches that are shorter than the diameter at their proximal end.
std::size_t stubby(const geometry::VesselGraph& tree) {
  std::size_t count = 0;
  for (const auto& branch : geometry::branches(tree, geometry::GraphIncidence(tree))) {
    double length = 0.0;
    for (const std::int32_t index : branch.edges) {
      const geometry::GraphEdge& edge = tree.edges[static_cast<std::size_t>(index)];
      length +=
          (tree.points[static_cast<std::size_t>(edge.to)] - tree.points[static_cast<std::size_t>(edge.from)])
              .norm();
    }
    if (length < 2.0 * tree.edges[static_cast<std::size_t>(branch.edges.front())].radius_from) ++count;
  }
  return count;
}

/// The argument: how many rounds of untangling at most; 40 are the default.
void reconstruct_tree(benchmark::State& state) {
  const geometry::VesselGraph tree = first_branches(grown(), 2000);
  reconstruction::ReconstructionOptions options;
  options.level = 2;
  options.untangling = static_cast<int>(state.range(0));
  core::set_max_threads(2);
  reconstruction::ReconstructedSurface made;
  for (auto _ : state) made = reconstruction::reconstruct_surface(tree, options);
  core::set_max_threads(0);
  state.counters["branches"] =
      static_cast<double>(geometry::branches(tree, geometry::GraphIncidence(tree)).size());
  state.counters["triangles"] = static_cast<double>(made.surface.mesh.triangles.size());
  state.counters["self_intersections"] = static_cast<double>(made.self_intersections);
  state.counters["at_forks"] = static_cast<double>(crossings_at_forks(tree, made));
  state.counters["stubby"] = static_cast<double>(stubby(tree));
  state.counters["narrowed"] = static_cast<double>(made.narrowed.size());
  state.counters["closed"] = geometry::find_faults(made.surface.mesh, false).closed_manifold() ? 1.0 : 0.0;
}
BENCHMARK(reconstruct_tree)->Arg(0)->Arg(40)->Unit(benchmark::kSecond)->Iterations(1)->UseRealTime();

}  // namespace
