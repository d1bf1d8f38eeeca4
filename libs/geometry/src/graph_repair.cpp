#include "ostia/geometry/graph_repair.h"

#include "graph_checks.h"
#include "graph_order.h"
#include "graph_radii.h"

#include "ostia/core/error.h"
#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/kd_tree.h"

#include <cmath>
#include <numeric>

namespace ostia::geometry {
namespace {

/// Keeps the edges for which `keep` holds; how many went.
template <class Keep>
std::size_t keep_edges(VesselGraph& graph, const Keep& keep) {
  std::size_t kept = 0;
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    if (!keep(e)) continue;
    graph.edges[kept] = graph.edges[e];
    graph.references[kept++] = graph.references[e];
  }
  const std::size_t dropped = graph.edges.size() - kept;
  graph.edges.resize(kept);
  graph.references.resize(kept);
  return dropped;
}

/// The point that each one becomes: the first of those at its place.
std::vector<std::int32_t> joined(const VesselGraph& graph, double within_mm, const core::TaskContext& task) {
  const std::vector<bool> finite = finite_points(graph);
  std::vector<std::int32_t> first = first_at_its_place(graph.points, finite);
  if (within_mm <= 0.0) return first;
  std::vector<Vec3> places;
  std::vector<std::int32_t> whose;
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    if (!finite[i] || first[i] != static_cast<std::int32_t>(i)) continue;
    places.push_back(graph.points[i]);
    whose.push_back(static_cast<std::int32_t>(i));
  }
  if (places.empty()) return first;
  DisjointSets sets(graph.points.size());
  const KdTree tree(places);
  for (std::size_t i = 0; i < places.size(); ++i) {
    task.throw_if_cancelled();  // a distance as wide as the network makes each of these long
    for (const std::int32_t near : tree.within(places[i], within_mm))
      sets.join(whose[i], whose[static_cast<std::size_t>(near)]);
  }
  for (std::int32_t& f : first) f = sets.find(f);
  return first;
}

std::size_t join_points(VesselGraph& graph, double within_mm, const core::TaskContext& task) {
  const std::vector<std::int32_t> first = joined(graph, within_mm, task);
  std::size_t count = 0;
  for (std::size_t i = 0; i < first.size(); ++i) count += first[i] != static_cast<std::int32_t>(i);
  if (count == 0) return 0;
  for (GraphEdge& edge : graph.edges) {
    edge.from = first[static_cast<std::size_t>(edge.from)];
    edge.to = first[static_cast<std::size_t>(edge.to)];
  }
  return count;
}

bool has_length(const GraphEdge& edge) {
  return edge.from != edge.to;
}

PointRadii radii_without_length(const VesselGraph& graph) {
  PointRadii radii(graph.points.size());
  for (const GraphEdge& edge : graph.edges) {
    if (has_length(edge)) continue;
    radii.add(edge.from, edge.radius_from);
    radii.add(edge.to, edge.radius_to);
  }
  return radii;
}

std::size_t count_lacking(const VesselGraph& graph, const std::vector<std::int32_t>& twins) {
  std::size_t count = 0;
  for (std::size_t e = 0; e < twins.size(); ++e)
    count += twins[e] == static_cast<std::int32_t>(e) && lacks_radius(graph.edges[e]);
  return count;
}

/// Gives each first edge between two points the radii that it lacks and the next one between them has.
void take_from_twins(VesselGraph& graph, const std::vector<std::int32_t>& twins) {
  for (std::size_t e = 0; e < twins.size(); ++e) {
    const GraphEdge& twin = graph.edges[e];
    GraphEdge& first = graph.edges[static_cast<std::size_t>(twins[e])];
    const bool along = twin.from == first.from;
    if (!known_radius(first.radius_from)) first.radius_from = along ? twin.radius_from : twin.radius_to;
    if (!known_radius(first.radius_to)) first.radius_to = along ? twin.radius_to : twin.radius_from;
  }
}

/// Drops segments without length and repeated ones, and fills radii from all that were there.
template <class Done>
void drop_and_fill(VesselGraph& graph, const Done& done, const core::TaskContext& task) {
  const PointRadii spare = radii_without_length(graph);
  done("zero_length_dropped", keep_edges(graph, [&](std::size_t e) { return has_length(graph.edges[e]); }),
       "segments without length dropped");
  const std::vector<std::int32_t> twins = first_between_its_points(graph);
  std::size_t lacking = count_lacking(graph, twins);
  take_from_twins(graph, twins);
  done("duplicate_dropped",
       keep_edges(graph, [&](std::size_t e) { return twins[e] == static_cast<std::int32_t>(e); }),
       "segments that were there already dropped");
  fill_radii(graph, spare, task);
  for (const GraphEdge& edge : graph.edges) lacking -= lacks_radius(edge) ? 1 : 0;
  done("radii_filled", lacking, "segments whose radii were taken from their neighbours");
}

}  // namespace

void validate(const GraphRepairOptions& options) {
  if (!(options.merge_within_mm >= 0.0) || !std::isfinite(options.merge_within_mm))
    throw InvalidInput("points are joined within 0 mm or more, not " +
                       std::to_string(options.merge_within_mm));
  for (const Vec3& root : options.roots)
    if (!root.allFinite()) throw InvalidInput("the place of a root must have finite coordinates");
}

RepairedGraph repaired(VesselGraph graph, const GraphRepairOptions& options, const core::TaskContext& task) {
  validate(options);
  check_size(graph);
  RepairedGraph out;
  const auto done = [&](const char* what, std::size_t count, const std::string& text) {
    if (count > 0) out.steps.push_back({what, count, text + ": " + std::to_string(count)});
    task.throw_if_cancelled();
  };
  if (graph.references.size() != graph.edges.size()) {
    graph.references.resize(graph.edges.size());
    std::iota(graph.references.begin(), graph.references.end(), 0);
  }
  done("index_out_of_range_dropped",
       keep_edges(graph, [&](std::size_t e) { return within(graph, graph.edges[e]); }),
       "segments that named points which are not there dropped");
  const auto finite = [&](std::int32_t p) { return graph.points[static_cast<std::size_t>(p)].allFinite(); };
  done("non_finite_dropped",
       keep_edges(graph,
                  [&](std::size_t e) { return finite(graph.edges[e].from) && finite(graph.edges[e].to); }),
       "segments at points that are not finite dropped");
  done("points_joined", join_points(graph, options.merge_within_mm, task), "points at one place joined");
  task.set_progress(0.2);
  drop_and_fill(graph, done, task);
  task.set_progress(0.5);
  if (graph.edges.empty()) throw InvalidInput("the network has no segment left after its repair");
  done("turned", turn_from_roots(graph, options), "segments turned away from their root");
  task.set_progress(0.6);
  done("ordered", put_in_order(graph) ? graph.edges.size() : 0, "segments and points put in order");
  task.set_progress(0.8);
  out.left = find_faults(graph, task.sub(0.8, 1.0));
  out.graph = std::move(graph);
  return out;
}

}  // namespace ostia::geometry
