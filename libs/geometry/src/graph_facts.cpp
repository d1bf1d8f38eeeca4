// What there is in a network of vessels: counts, lengths, radii.

#include "graph_checks.h"

#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/graph_faults.h"
#include "ostia/geometry/graph_units.h"

#include <algorithm>
#include <cmath>

namespace ostia::geometry {
namespace {

void add_radii(const GraphEdge& edge, GraphFacts& facts) {
  for (const double r : {edge.radius_from, edge.radius_to}) {
    if (!(std::isfinite(r) && r > 0.0)) continue;
    if (facts.largest_radius_mm == 0.0) facts.least_radius_mm = r;
    facts.least_radius_mm = std::min(facts.least_radius_mm, r);
    facts.largest_radius_mm = std::max(facts.largest_radius_mm, r);
  }
}

void add_edges(const VesselGraph& graph, const std::vector<bool>& finite, const Degrees& degrees,
               DisjointSets& parts, GraphFacts& facts) {
  for (const GraphEdge& edge : graph.edges) {
    add_radii(edge, facts);
    if (!within(graph, edge)) continue;
    const auto a = static_cast<std::size_t>(edge.from), b = static_cast<std::size_t>(edge.to);
    if (finite[a] && finite[b]) facts.length_mm += (graph.points[b] - graph.points[a]).norm();
    if (parts.find(edge.from) == parts.find(edge.to))
      ++facts.loops;
    else
      parts.join(edge.from, edge.to);
    // A branch begins wherever the point before it is no mere bend.
    facts.branches += degrees.leaving[a] != 1 || degrees.arriving[a] != 1;
  }
}

void add_points(const Degrees& degrees, DisjointSets& parts, GraphFacts& facts) {
  const std::size_t count = degrees.leaving.size();
  std::vector<bool> circle(count, true);  // by part: it has nothing but bends, and is one branch
  for (std::size_t i = 0; i < count; ++i) {
    const std::int32_t out = degrees.leaving[i], in = degrees.arriving[i];
    facts.roots += in == 0 && out > 0;
    facts.ends += out == 0 && in > 0;
    facts.forks += out >= 2;
    facts.trifurcations += out >= 3;
    facts.joins += in >= 2;
    if (in != 1 || out != 1)
      circle[static_cast<std::size_t>(parts.find(static_cast<std::int32_t>(i)))] = false;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (parts.find(static_cast<std::int32_t>(i)) != static_cast<std::int32_t>(i)) continue;
    facts.parts += degrees.leaving[i] + degrees.arriving[i] > 0;
    facts.branches += circle[i];
  }
}

}  // namespace

GraphFacts facts_of(const VesselGraph& graph, const core::TaskContext& task) {
  check_size(graph);
  GraphFacts facts;
  facts.points = graph.points.size();
  facts.segments = graph.edges.size();
  const std::vector<bool> finite = finite_points(graph);
  for (std::size_t i = 0; i < finite.size(); ++i)
    if (finite[i]) facts.box.extend(graph.points[i]);
  task.throw_if_cancelled();
  const Degrees degrees = degrees_of(graph);
  DisjointSets parts(graph.points.size());
  add_edges(graph, finite, degrees, parts, facts);
  task.throw_if_cancelled();
  add_points(degrees, parts, facts);
  task.set_progress(1.0);
  return facts;
}

std::string unit_doubt(const GraphFacts& facts) {
  if (!(facts.least_radius_mm * static_cast<double>(facts.branches) > facts.length_mm)) return {};
  return "its branches are shorter on average than the least radius: are radii and places in different "
         "units? "
         "`ostia convert --units m --radius-units mm` settles it";
}

}  // namespace ostia::geometry
