#include "graph_order.h"

#include "graph_checks.h"

#include "ostia/geometry/disjoint_sets.h"
#include "ostia/geometry/kd_tree.h"

#include <algorithm>
#include <limits>
#include <queue>

namespace ostia::geometry {
namespace {

/// What decides about a part's direction.
struct Part {
  std::int32_t roots = 0, joins = 0;
  std::int32_t best = -1;  ///< the end of greatest radius, or the point where there is no end
  bool best_is_end = false;
  double best_radius = -1.0;
  bool loops = false, given = false, turned = false;
};

class Turner {
 public:
  Turner(VesselGraph& graph, const GraphRepairOptions& options)
      : graph_(graph), options_(options), sets_(graph.points.size()), parts_(graph.points.size()) {}

  std::size_t run() {
    find_parts();
    const std::vector<std::int32_t> starts = choose_starts();
    if (starts.empty()) return 0;
    return turn(ranks(starts));
  }

 private:
  Part& part_of(std::int32_t point) { return parts_[static_cast<std::size_t>(sets_.find(point))]; }

  void find_parts() {
    std::vector<std::int32_t> closing;
    for (const GraphEdge& edge : graph_.edges) {
      if (sets_.find(edge.from) == sets_.find(edge.to))
        closing.push_back(edge.from);
      else
        sets_.join(edge.from, edge.to);
    }
    for (const std::int32_t point : closing) part_of(point).loops = true;
    const Degrees degrees = degrees_of(graph_);
    for (std::size_t i = 0; i < graph_.points.size(); ++i) {
      Part& part = part_of(static_cast<std::int32_t>(i));
      part.roots += degrees.arriving[i] == 0 && degrees.leaving[i] > 0;
      part.joins += degrees.arriving[i] > 1;
    }
    for (const GraphEdge& edge : graph_.edges) {
      consider(edge.from, edge.radius_from, degrees);
      consider(edge.to, edge.radius_to, degrees);
    }
  }

  void consider(std::int32_t point, double radius, const Degrees& degrees) {
    Part& part = part_of(point);
    const auto at = static_cast<std::size_t>(point);
    const bool end = degrees.leaving[at] + degrees.arriving[at] == 1;
    const double r = radius > 0.0 ? radius : 0.0;  // one that is missing is none
    const bool better =
        end != part.best_is_end ? end : r > part.best_radius || (r == part.best_radius && point < part.best);
    if (!better) return;
    part.best = point;
    part.best_is_end = end;
    part.best_radius = r;
  }

  std::vector<std::int32_t> used_points() const {
    std::vector<std::int32_t> used;
    for (const GraphEdge& edge : graph_.edges) used.insert(used.end(), {edge.from, edge.to});
    std::sort(used.begin(), used.end());
    used.erase(std::unique(used.begin(), used.end()), used.end());
    return used;
  }

  std::vector<std::int32_t> choose_starts() {
    std::vector<std::int32_t> starts;
    if (!options_.roots.empty()) {
      const std::vector<std::int32_t> used = used_points();
      std::vector<Vec3> places;
      for (const std::int32_t point : used) places.push_back(graph_.points[static_cast<std::size_t>(point)]);
      const KdTree tree(std::move(places));
      for (const Vec3& root : options_.roots) {
        starts.push_back(used[static_cast<std::size_t>(tree.nearest(root))]);
        part_of(starts.back()).given = part_of(starts.back()).turned = true;
      }
    }
    for (Part& part : parts_) {
      if (part.best < 0 || part.given || options_.keep_directions) continue;
      const bool faulty = part.loops ? part.roots == 0 : part.roots != 1 || part.joins > 0;
      if (!faulty) continue;
      part.turned = true;
      starts.push_back(part.best);
    }
    return starts;
  }

  /// Points in the order of their way along the segments from the nearest start (Dijkstra); the last of all
  /// in parts that have none. A way that a segment is too short to lengthen still comes after the one before.
  std::vector<std::int32_t> ranks(const std::vector<std::int32_t>& starts) const {
    std::vector<std::int32_t> rank(graph_.points.size(), std::numeric_limits<std::int32_t>::max());
    std::int32_t next = 0;
    std::vector<double> distance(graph_.points.size(), std::numeric_limits<double>::infinity());
    const GraphIncidence incidence(graph_);
    using Reached = std::pair<double, std::int32_t>;
    std::priority_queue<Reached, std::vector<Reached>, std::greater<>> front;
    const auto reach = [&](std::int32_t point, double d) {
      if (d >= distance[static_cast<std::size_t>(point)]) return;
      distance[static_cast<std::size_t>(point)] = d;
      front.emplace(d, point);
    };
    for (const std::int32_t start : starts) reach(start, 0.0);
    while (!front.empty()) {
      const auto [d, point] = front.top();
      front.pop();
      if (d > distance[static_cast<std::size_t>(point)]) continue;
      rank[static_cast<std::size_t>(point)] = next++;
      for (const std::int32_t e : incidence.leaving(point)) reach(edge(e).to, d + length(edge(e)));
      for (const std::int32_t e : incidence.arriving(point)) reach(edge(e).from, d + length(edge(e)));
    }
    return rank;
  }

  std::size_t turn(const std::vector<std::int32_t>& rank) {
    std::size_t count = 0;
    for (GraphEdge& edge : graph_.edges) {
      if (rank[static_cast<std::size_t>(edge.to)] >= rank[static_cast<std::size_t>(edge.from)]) continue;
      std::swap(edge.from, edge.to);
      std::swap(edge.radius_from, edge.radius_to);
      ++count;
    }
    return count;
  }

  const GraphEdge& edge(std::int32_t e) const { return graph_.edges[static_cast<std::size_t>(e)]; }
  double length(const GraphEdge& e) const {
    return (graph_.points[static_cast<std::size_t>(e.to)] - graph_.points[static_cast<std::size_t>(e.from)])
        .norm();
  }

  VesselGraph& graph_;
  const GraphRepairOptions& options_;
  DisjointSets sets_;
  std::vector<Part> parts_;
};

/// Edges so that a point's arriving ones come before its leaving ones, depth first; where a circle forbids
/// that, from its edge of the lowest index on.
std::vector<std::int32_t> ordered_edges(const VesselGraph& graph) {
  const GraphIncidence incidence(graph);
  std::vector<std::int32_t> waiting = degrees_of(graph).arriving;
  std::vector<bool> opened(graph.points.size(), false);
  std::vector<std::int32_t> order, stack;
  order.reserve(graph.edges.size());
  const auto open = [&](std::int32_t point) {
    if (opened[static_cast<std::size_t>(point)]) return;
    opened[static_cast<std::size_t>(point)] = true;
    const auto row = incidence.leaving(point);
    stack.insert(stack.end(), row.rbegin(), row.rend());  // the first of them is taken first
  };
  const auto drain = [&] {
    while (!stack.empty()) {
      const std::int32_t e = stack.back();
      stack.pop_back();
      order.push_back(e);
      const std::int32_t to = graph.edges[static_cast<std::size_t>(e)].to;
      if (--waiting[static_cast<std::size_t>(to)] == 0) open(to);
    }
  };
  const std::vector<std::int32_t> arriving = waiting;
  for (const GraphEdge& edge : graph.edges) {
    if (arriving[static_cast<std::size_t>(edge.from)] > 0) continue;
    open(edge.from);
    drain();
  }
  for (const GraphEdge& edge : graph.edges) {
    open(edge.from);
    drain();
  }
  return order;
}

}  // namespace

std::size_t turn_from_roots(VesselGraph& graph, const GraphRepairOptions& options) {
  return Turner(graph, options).run();
}

bool put_in_order(VesselGraph& graph) {
  const std::vector<std::int32_t> order = ordered_edges(graph);
  VesselGraph sorted;
  std::vector<std::int32_t> number(graph.points.size(), -1);
  const auto numbered = [&](std::int32_t point) {
    std::int32_t& n = number[static_cast<std::size_t>(point)];
    if (n < 0) {
      n = static_cast<std::int32_t>(sorted.points.size());
      sorted.points.push_back(graph.points[static_cast<std::size_t>(point)]);
    }
    return n;
  };
  sorted.points.reserve(graph.points.size());
  sorted.edges.reserve(order.size());
  bool changed = false;
  for (std::size_t i = 0; i < order.size(); ++i) {
    GraphEdge edge = graph.edges[static_cast<std::size_t>(order[i])];
    const std::int32_t from = edge.from, to = edge.to;
    edge.from = numbered(from);
    edge.to = numbered(to);
    changed = changed || order[i] != static_cast<std::int32_t>(i) || edge.from != from || edge.to != to;
    sorted.edges.push_back(edge);
    if (!graph.references.empty())
      sorted.references.push_back(graph.references[static_cast<std::size_t>(order[i])]);
  }
  changed = changed || sorted.points.size() != graph.points.size();
  graph = std::move(sorted);
  return changed;
}

}  // namespace ostia::geometry
