#include "ostia/analysis/graph_measures.h"
#include "ostia/core/error.h"

#include <cmath>
#include <string>

namespace ostia::analysis {
namespace {

using geometry::GraphEdge;
using geometry::GraphIncidence;
using geometry::VesselGraph;

constexpr const char* way_out = "; ostia convert --repair mends what can be mended";

std::string named(const VesselGraph& graph, std::size_t edge) {
  const std::string index = std::to_string(edge);
  if (graph.references.empty()) return "segment " + index;
  return "segment " + index + " (" + std::to_string(graph.references[edge]) + " in its file)";
}

void check_links(const VesselGraph& graph) {
  if (graph.edges.empty()) throw InvalidInput("a tree without segments cannot be measured");
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    for (const double radius : {edge.radius_from, edge.radius_to})
      if (!std::isfinite(radius) || radius < 0.0)
        throw InvalidInput(named(graph, e) + " has the radius " + std::to_string(radius) + " mm" + way_out);
    for (const std::int32_t point : {edge.from, edge.to})
      if (!graph.points[static_cast<std::size_t>(point)].allFinite())
        throw InvalidInput("point " + std::to_string(point) + " of " + named(graph, e) +
                           " is no place in space" + way_out);
  }
}

/// The edges breadth first, and the parent of each.
void walk_outward(const VesselGraph& graph, const GraphIncidence& incidence, TreeLinks& links) {
  links.parent.assign(graph.edges.size(), -1);
  links.outward.reserve(graph.edges.size());
  for (std::size_t p = 0; p < graph.points.size(); ++p) {
    const auto point = static_cast<std::int32_t>(p);
    const auto arriving = incidence.arriving(point);
    if (arriving.size() > 1)
      throw InvalidInput(
          named(graph, static_cast<std::size_t>(arriving[1])) + " joins " +
          named(graph, static_cast<std::size_t>(arriving[0])) + " at point " + std::to_string(point) +
          ": orders and totals need a tree, where each point has one " + "segment before it" + way_out);
    if (arriving.empty())
      for (const std::int32_t e : incidence.leaving(point)) links.outward.push_back(e);
  }
  for (std::size_t k = 0; k < links.outward.size(); ++k) {
    const std::int32_t e = links.outward[k];
    for (const std::int32_t child : incidence.leaving(graph.edges[static_cast<std::size_t>(e)].to)) {
      links.parent[static_cast<std::size_t>(child)] = e;
      links.outward.push_back(child);
    }
  }
}

void refuse_loops(const VesselGraph& graph, const TreeLinks& links) {
  if (links.outward.size() == graph.edges.size()) return;
  std::vector<bool> reached(graph.edges.size(), false);
  for (const std::int32_t e : links.outward) reached[static_cast<std::size_t>(e)] = true;
  for (std::size_t e = 0; e < reached.size(); ++e)
    if (!reached[e])
      throw InvalidInput(named(graph, e) + " is part of a loop without a root, or hangs on one: orders and " +
                         "totals need a tree" + way_out);
}

void link_branches(TreeLinks& links) {
  links.branch_of.assign(links.parent.size(), -1);
  links.branch_parent.assign(links.branches.size(), -1);
  for (std::size_t b = 0; b < links.branches.size(); ++b)
    for (const std::int32_t e : links.branches[b].edges)
      links.branch_of[static_cast<std::size_t>(e)] = static_cast<std::int32_t>(b);
  links.branches_outward.reserve(links.branches.size());
  for (const std::int32_t e : links.outward) {
    const std::int32_t b = links.branch_of[static_cast<std::size_t>(e)];
    if (links.branches[static_cast<std::size_t>(b)].edges.front() != e) continue;
    links.branches_outward.push_back(b);
    const std::int32_t parent = links.parent[static_cast<std::size_t>(e)];
    if (parent >= 0)
      links.branch_parent[static_cast<std::size_t>(b)] = links.branch_of[static_cast<std::size_t>(parent)];
  }
}

}  // namespace

TreeLinks link_tree(const VesselGraph& graph, const GraphIncidence& incidence,
                    const core::TaskContext& task) {
  check_links(graph);
  TreeLinks links;
  walk_outward(graph, incidence, links);
  refuse_loops(graph, links);
  task.throw_if_cancelled();
  links.branches = geometry::branches(graph, incidence);
  link_branches(links);
  task.throw_if_cancelled();
  return links;
}

}  // namespace ostia::analysis
