#include "graph_editor.h"

#include "ostia/centerline/skeleton_graph.h"
#include "ostia/core/error.h"
#include "ostia/geometry/centerline.h"

#include <algorithm>
#include <map>
#include <set>
#include <string>
#include <utility>

namespace ostia::centerline {
namespace {

struct Reach {
  double distance_mm = 0.0;
  std::int32_t parent_edge = -1;
};

// The shortest directed way to each node from the nodes that no edge leads to.
std::map<std::int32_t, Reach> reaches(const SkeletonGraph& graph) {
  std::map<std::int32_t, std::vector<const SkeletonEdge*>> leaving;
  std::set<std::int32_t> entered;
  for (const SkeletonEdge& e : graph.edges) {
    leaving[e.from].push_back(&e);
    if (e.from != e.to) entered.insert(e.to);
  }
  std::map<std::int32_t, Reach> result;
  std::set<std::pair<double, std::int32_t>> open;
  for (const SkeletonNode& n : graph.nodes) {
    if (entered.count(n.id) != 0 || n.kind == SkeletonNodeKind::point) continue;
    result[n.id] = {};
    open.insert({0.0, n.id});
  }
  while (!open.empty()) {
    const auto [d, n] = *open.begin();
    open.erase(open.begin());
    if (d > result.at(n).distance_mm) continue;
    for (const SkeletonEdge* e : leaving[n]) {
      const double there = d + length_mm(*e);
      const auto known = result.find(e->to);
      if (known != result.end() && known->second.distance_mm <= there) continue;
      result[e->to] = {there, e->id};
      open.insert({there, e->to});
    }
  }
  return result;
}

class TreeFiller {
 public:
  TreeFiller(const SkeletonGraph& graph, double step_mm) : graph_(graph), step_mm_(step_mm) {}

  SkeletonTree fill() {
    const std::map<std::int32_t, Reach> reach = reaches(graph_);
    std::vector<const SkeletonEdge*> order;
    for (const SkeletonEdge& e : graph_.edges) {
      if (reach.count(e.from) == 0)
        throw InvalidInput("vessel tree: edge " + std::to_string(e.id) +
                           " is on a directed circle that no root leads to; orient the skeleton with guess");
      order.push_back(&e);
    }
    std::sort(order.begin(), order.end(), [&](const SkeletonEdge* a, const SkeletonEdge* b) {
      return std::make_pair(reach.at(a->from).distance_mm, a->id) <
             std::make_pair(reach.at(b->from).distance_mm, b->id);
    });
    for (const SkeletonNode& n : graph_.nodes)
      if (n.kind != SkeletonNodeKind::point) result_.tree.nodes.push_back({n.id, n.position});
    next_node_ = graph_.nodes.empty() ? 0 : graph_.nodes.back().id + 1;
    for (const SkeletonEdge* e : order) add(*e, reach.at(e->to).parent_edge == e->id);
    add_vessels();
    return std::move(result_);
  }

 private:
  void add(const SkeletonEdge& e, bool parent) {
    geometry::TreeSegment segment;
    segment.id = static_cast<std::int32_t>(result_.tree.segments.size());
    segment.from = e.from;
    segment.to = e.to;
    if (!parent) {
      segment.to = next_node_++;
      result_.tree.nodes.push_back({segment.to, e.points.back()});
      result_.opened_edges.push_back(e.id);
    }
    segment.axis.points = e.points;
    segment.axis.radius = e.radius_mm;
    const auto before = last_normal_.find(e.from);
    const Vec3 normal = before == last_normal_.end() ? Vec3(Vec3::Zero()) : before->second;
    geometry::complete(segment.axis, normal);
    segment.axis = geometry::resample(segment.axis, step_mm_);
    geometry::complete(segment.axis, normal);
    last_normal_[segment.to] = segment.axis.frames.back().normal;
    segment_to_[segment.to] = segment.id;
    result_.edge_of_segment.push_back(e.id);
    result_.tree.segments.push_back(std::move(segment));
  }

  void add_vessels() {
    for (const std::int32_t end : geometry::ends(result_.tree)) {
      geometry::Vessel vessel;
      std::int32_t at = end;
      for (auto into = segment_to_.find(at); into != segment_to_.end(); into = segment_to_.find(at)) {
        vessel.segments.push_back(into->second);
        at = result_.tree.segments[static_cast<std::size_t>(into->second)].from;
      }
      if (vessel.segments.empty()) continue;
      std::reverse(vessel.segments.begin(), vessel.segments.end());
      vessel.id = static_cast<std::int32_t>(result_.tree.vessels.size());
      vessel.name = "vessel_" + std::to_string(vessel.id + 1);
      result_.tree.vessels.push_back(std::move(vessel));
    }
  }

  const SkeletonGraph& graph_;
  double step_mm_;
  SkeletonTree result_;
  std::int32_t next_node_ = 0;
  std::map<std::int32_t, std::int32_t> segment_to_;  // by node
  std::map<std::int32_t, Vec3> last_normal_;         // by node
};

}  // namespace

SkeletonTree vessel_tree(const SkeletonGraph& graph, double step_mm) {
  detail::require(step_mm > 0.0 && step_mm <= 10.0, "vessel tree", "step_mm", step_mm, "(0, 10] mm");
  detail::require_sound(graph, "vessel tree");
  if (!graph.oriented)
    throw InvalidInput("vessel tree: the skeleton's lines have no direction yet; use oriented() first");
  return TreeFiller(graph, step_mm).fill();
}

}  // namespace ostia::centerline
