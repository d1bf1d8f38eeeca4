#include "ostia/geometry/graph_tree.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_faults.h"

#include <algorithm>
#include <unordered_map>

namespace ostia::geometry {
namespace {

TreeSegment segment_of(const VesselGraph& graph, const GraphBranch& branch, std::int32_t id) {
  const auto edge = [&](std::size_t i) { return graph.edges[static_cast<std::size_t>(branch.edges[i])]; };
  const auto place = [&](std::int32_t p) { return graph.points[static_cast<std::size_t>(p)]; };
  TreeSegment segment;
  segment.id = id;
  segment.from = edge(0).from;
  segment.to = edge(branch.edges.size() - 1).to;
  segment.axis.points.push_back(place(segment.from));
  segment.axis.radius.push_back(edge(0).radius_from);
  for (std::size_t i = 0; i < branch.edges.size(); ++i) {
    const bool last = i + 1 == branch.edges.size();
    segment.axis.points.push_back(place(edge(i).to));
    segment.axis.radius.push_back(last ? edge(i).radius_to
                                       : 0.5 * (edge(i).radius_to + edge(i + 1).radius_from));
  }
  complete(segment.axis);
  return segment;
}

}  // namespace

VesselGraph graph_of(const VesselTree& tree) {
  VesselGraph graph;
  std::unordered_map<std::int32_t, std::int32_t> index;
  for (const TreeNode& node : tree.nodes) {
    index.emplace(node.id, static_cast<std::int32_t>(graph.points.size()));
    graph.points.push_back(node.position);
  }
  for (const TreeSegment& segment : tree.segments) {
    const auto from = index.find(segment.from), to = index.find(segment.to);
    const std::size_t n = segment.axis.size();
    const std::string name = "segment " + std::to_string(segment.id) + " of the tree ";
    if (from == index.end() || to == index.end()) throw InvalidInput(name + "names a node that is not there");
    if (n < 2 || segment.axis.radius.size() != n)
      throw InvalidInput(name + "needs two points or more, and a radius for each");
    std::int32_t last = from->second;
    for (std::size_t i = 1; i < n; ++i) {
      std::int32_t next = to->second;
      if (i + 1 < n) {
        next = static_cast<std::int32_t>(graph.points.size());
        graph.points.push_back(segment.axis.points[i]);
      }
      graph.edges.push_back({last, next, segment.axis.radius[i - 1], segment.axis.radius[i]});
      graph.references.push_back(segment.id);
      last = next;
    }
  }
  return graph;
}

VesselTree tree_of(const VesselGraph& graph, const core::TaskContext& task) {
  require_sound(graph, "the network", true, task.sub(0.0, 0.5));
  const GraphIncidence incidence(graph);
  VesselTree tree;
  std::unordered_map<std::int32_t, std::int32_t> arriving;  // the segment that reaches a node
  std::vector<std::int32_t> nodes;
  for (const GraphBranch& branch : branches(graph, incidence)) {
    task.throw_if_cancelled();
    const auto id = static_cast<std::int32_t>(tree.segments.size());
    tree.segments.push_back(segment_of(graph, branch, id));
    arriving[tree.segments.back().to] = id;
    nodes.insert(nodes.end(), {tree.segments.back().from, tree.segments.back().to});
  }
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  for (const std::int32_t point : nodes) {
    tree.nodes.push_back({point, graph.points[static_cast<std::size_t>(point)]});
    if (!incidence.leaving(point).empty()) continue;
    Vessel vessel;
    vessel.id = static_cast<std::int32_t>(tree.vessels.size());
    vessel.name = "vessel_" + std::to_string(vessel.id + 1);
    for (auto at = arriving.find(point); at != arriving.end();
         at = arriving.find(tree.segments[static_cast<std::size_t>(at->second)].from))
      vessel.segments.push_back(at->second);
    std::reverse(vessel.segments.begin(), vessel.segments.end());
    tree.vessels.push_back(std::move(vessel));
  }
  return tree;
}

}  // namespace ostia::geometry
