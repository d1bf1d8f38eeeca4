#include "ostia/geometry/graph_faults.h"

#include "graph_checks.h"

#include "ostia/core/error.h"
#include "ostia/geometry/disjoint_sets.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::geometry {
namespace {

using Kind = GraphFaultKind;
constexpr std::size_t kinds = static_cast<std::size_t>(Kind::several_parts) + 1;
constexpr std::size_t places_kept = 5;

/// Counts of all kinds, and their first places.
class Counter {
 public:
  Counter() {
    for (std::size_t k = 0; k < kinds; ++k) faults_[k].kind = static_cast<Kind>(k);
  }
  void edge(Kind kind, std::size_t index) { add(fault(kind), fault(kind).edges, index); }
  void point(Kind kind, std::size_t index) { add(fault(kind), fault(kind).points, index); }
  GraphFaults all() const {
    GraphFaults faults;
    std::copy_if(faults_.begin(), faults_.end(), std::back_inserter(faults.found),
                 [](const GraphFault& fault) { return fault.count > 0; });
    return faults;
  }

 private:
  GraphFault& fault(Kind kind) { return faults_[static_cast<std::size_t>(kind)]; }
  static void add(GraphFault& fault, std::vector<std::int32_t>& places, std::size_t index) {
    if (++fault.count <= places_kept) places.push_back(static_cast<std::int32_t>(index));
  }
  std::array<GraphFault, kinds> faults_;
};

void check_edges(const VesselGraph& graph, const std::vector<bool>& finite, Counter& counter) {
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    const auto is = [&](auto wrong) { return wrong(edge.radius_from) || wrong(edge.radius_to); };
    if (is([](double r) { return !std::isfinite(r); })) counter.edge(Kind::missing_radius, e);
    if (is([](double r) { return std::isfinite(r) && r < 0.0; })) counter.edge(Kind::negative_radius, e);
    if (is([](double r) { return r == 0.0; })) counter.edge(Kind::zero_radius, e);
    if (!within(graph, edge)) {
      counter.edge(Kind::index_out_of_range, e);
      continue;
    }
    const auto a = static_cast<std::size_t>(edge.from), b = static_cast<std::size_t>(edge.to);
    if (a == b || (finite[a] && finite[b] && graph.points[a] == graph.points[b]))
      counter.edge(Kind::zero_length, e);
  }
}

void check_repeats(const VesselGraph& graph, const std::vector<bool>& finite, Counter& counter) {
  const std::vector<std::int32_t> same = first_at_its_place(graph.points, finite);
  for (std::size_t i = 0; i < same.size(); ++i)
    if (same[i] != static_cast<std::int32_t>(i)) counter.point(Kind::duplicate_point, i);
  const std::vector<std::int32_t> twins = first_between_its_points(graph);
  for (std::size_t e = 0; e < twins.size(); ++e)
    if (twins[e] != static_cast<std::int32_t>(e)) counter.edge(Kind::duplicate_segment, e);
}

void check_parents(const VesselGraph& graph, const Degrees& degrees, Counter& counter) {
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (degrees.leaving[i] == 0 && degrees.arriving[i] == 0) counter.point(Kind::loose_point, i);
    if (degrees.arriving[i] > 1) counter.point(Kind::several_parents, i);
  }
}

void check_parts(const VesselGraph& graph, const Degrees& degrees, Counter& counter) {
  DisjointSets sets(graph.points.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    if (!within(graph, edge)) continue;
    if (sets.find(edge.from) == sets.find(edge.to))
      counter.edge(Kind::cycle, e);
    else
      sets.join(edge.from, edge.to);
  }
  std::vector<bool> has_root(graph.points.size(), false);
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (degrees.leaving[i] == 0 || degrees.arriving[i] > 0) continue;
    const auto part = static_cast<std::size_t>(sets.find(static_cast<std::int32_t>(i)));
    if (has_root[part]) counter.point(Kind::several_roots, i);
    has_root[part] = true;
  }
  bool first = true;
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (sets.find(static_cast<std::int32_t>(i)) != static_cast<std::int32_t>(i) ||
        (degrees.leaving[i] == 0 && degrees.arriving[i] == 0))
      continue;
    if (!first) counter.point(Kind::several_parts, i);
    first = false;
    if (!has_root[i]) counter.point(Kind::no_root, i);
  }
}

bool any_of(const GraphFaults& faults, Kind from, Kind to) {
  return std::any_of(faults.found.begin(), faults.found.end(), [&](const GraphFault& fault) {
    return fault.kind >= from && fault.kind <= to && fault.kind != Kind::loose_point;
  });
}

}  // namespace

std::size_t GraphFaults::count(GraphFaultKind kind) const {
  for (const GraphFault& fault : found)
    if (fault.kind == kind) return fault.count;
  return 0;
}

bool GraphFaults::sound() const {
  return !any_of(*this, Kind::index_out_of_range, Kind::loose_point);
}
bool GraphFaults::sound_trees() const {
  return !any_of(*this, Kind::index_out_of_range, Kind::no_root);
}
bool GraphFaults::sound_tree() const {
  return !any_of(*this, Kind::index_out_of_range, Kind::several_parts);
}

GraphFaults find_faults(const VesselGraph& graph, const core::TaskContext& task) {
  check_size(graph);
  Counter counter;
  const std::vector<bool> finite = finite_points(graph);
  for (std::size_t i = 0; i < finite.size(); ++i)
    if (!finite[i]) counter.point(Kind::non_finite_point, i);
  check_edges(graph, finite, counter);
  task.throw_if_cancelled();
  check_repeats(graph, finite, counter);
  task.throw_if_cancelled();
  task.set_progress(0.6);
  const Degrees degrees = degrees_of(graph);
  check_parents(graph, degrees, counter);
  check_parts(graph, degrees, counter);
  task.throw_if_cancelled();
  task.set_progress(1.0);
  return counter.all();
}

}  // namespace ostia::geometry
