#include "ostia/centerline/skeleton_graph.h"

#include "graph_editor.h"
#include "voxel_graph.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>
#include <string>

namespace ostia::centerline {
namespace {

using detail::GraphEditor;
using detail::SkeletonVoxels;

constexpr double node_tolerance_mm = 1e-6;

// Walks the voxels of a skeleton and fills a graph.
class GraphMaker {
 public:
  GraphMaker(const Thinned& thin, const SkeletonVoxels& voxels) : thin_(thin), voxels_(voxels), editor_({}) {
    const imaging::Vec3& spacing = thin.mask.geometry.spacing;
    less_mm_ = 0.5 * spacing.minCoeff();
    least_mm_ = 0.25 * spacing.minCoeff();
    node_of_.assign(voxels.cells.size(), -1);
    walked_.assign(voxels.cells.size(), false);
  }

  SkeletonGraph make() {
    const std::vector<detail::Cluster> clusters = detail::clusters_of(voxels_, cluster_of_);
    for (const detail::Cluster& cluster : clusters) add_cluster(cluster);
    for (std::int32_t v = 0; v < count(); ++v)
      if (voxels_.degree(v) <= 1) node_of_[index(v)] = editor_.add_node(position(v), radius(v));
    for (std::int32_t v = 0; v < count(); ++v)
      if (node_of_[index(v)] >= 0) add_lines_from(v);
    for (std::int32_t v = 0; v < count(); ++v)
      if (node_of_[index(v)] < 0 && !walked_[index(v)]) add_ring(v);
    for (const detail::Cluster& cluster : clusters) tidy_cluster(cluster);
    return editor_.graph();
  }

 private:
  static std::size_t index(std::int32_t v) { return static_cast<std::size_t>(v); }
  std::int32_t count() const { return static_cast<std::int32_t>(voxels_.cells.size()); }
  Vec3 position(std::int32_t v) const {
    const detail::Cell& c = voxels_.cells[index(v)];
    return thin_.mask.geometry.world(
        Vec3(static_cast<double>(c[0]), static_cast<double>(c[1]), static_cast<double>(c[2])));
  }
  double radius(std::int32_t v) const {
    return std::max(least_mm_, static_cast<double>(thin_.distance_mm[index(v)]) - less_mm_);
  }

  void add_cluster(const detail::Cluster& cluster) {
    if (!cluster.lines.empty()) {
      for (const std::int32_t v : cluster.voxels)
        node_of_[index(v)] = editor_.add_node(position(v), radius(v));
      for (const auto& [a, b] : cluster.lines) add_edge(a, b, {});
      return;
    }
    Vec3 mean = Vec3::Zero();
    double widest = 0.0;
    for (const std::int32_t v : cluster.voxels) {
      mean += position(v);
      widest = std::max(widest, radius(v));
    }
    const std::int32_t id = editor_.add_node(mean / static_cast<double>(cluster.voxels.size()), widest);
    for (const std::int32_t v : cluster.voxels) node_of_[index(v)] = id;
  }

  void add_edge(std::int32_t from, std::int32_t to, const std::vector<std::int32_t>& between) {
    const SkeletonNode& a = editor_.node(node_of_[index(from)]);
    const SkeletonNode& b = editor_.node(node_of_[index(to)]);
    std::vector<Vec3> points{a.position};
    std::vector<double> radii{a.radius_mm};
    for (const std::int32_t v : between) {
      points.push_back(position(v));
      radii.push_back(radius(v));
    }
    points.push_back(b.position);
    radii.push_back(b.radius_mm);
    editor_.add_edge(a.id, b.id, std::move(points), std::move(radii));
  }

  // The voxels from `first` (beside `before`) to the next node's voxel, which is the last.
  std::vector<std::int32_t> walk(std::int32_t before, std::int32_t first) {
    std::vector<std::int32_t> line{first};
    while (node_of_[index(line.back())] < 0) {
      const std::int32_t at = line.back();
      walked_[index(at)] = true;
      const auto& two = voxels_.neighbours[index(at)];
      const std::int32_t next = two[0] == before ? two[1] : two[0];
      before = at;
      line.push_back(next);
    }
    return line;
  }

  void add_lines_from(std::int32_t v) {
    for (const std::int32_t w : voxels_.neighbours[index(v)]) {
      const bool direct = node_of_[index(w)] >= 0;
      if (direct ? !joined_directly(v, w) : walked_[index(w)]) continue;
      std::vector<std::int32_t> line = walk(v, w);
      const std::int32_t end = line.back();
      line.pop_back();
      add_edge(v, end, line);
    }
  }

  // An end beside a junction or another end; each pair once.
  bool joined_directly(std::int32_t v, std::int32_t w) const {
    const bool inner_v = cluster_of_[index(v)] >= 0, inner_w = cluster_of_[index(w)] >= 0;
    if (inner_v) return false;
    return inner_w || v < w;
  }

  // A closed line without junction; its first voxel is its anchor.
  void add_ring(std::int32_t v) {
    node_of_[index(v)] = editor_.add_node(position(v), radius(v));
    std::vector<std::int32_t> line = walk(v, voxels_.neighbours[index(v)][0]);
    line.pop_back();
    add_edge(v, v, line);
  }

  // Voxels of a cluster with loops that lines pass or end at are no nodes.
  void tidy_cluster(const detail::Cluster& cluster) {
    if (cluster.lines.empty()) return;
    std::set<std::int32_t> left;
    for (const std::int32_t v : cluster.voxels) left.insert(node_of_[index(v)]);
    bool changed = true;
    while (changed) {
      changed = false;
      for (auto at = left.begin(); at != left.end();) {
        if (editor_.degree(*at) != 1) {
          ++at;
          continue;
        }
        editor_.remove_edge(*editor_.edges_at(*at).begin());
        editor_.remove_node(*at);
        at = left.erase(at);
        changed = true;
      }
    }
    for (const std::int32_t n : left) editor_.join_at(n);
  }

  const Thinned& thin_;
  const SkeletonVoxels& voxels_;
  GraphEditor editor_;
  double less_mm_ = 0.0, least_mm_ = 0.0;
  std::vector<std::int32_t> cluster_of_, node_of_;
  std::vector<bool> walked_;
};

template <class Items>
const typename Items::value_type& by_id(const Items& items, std::int32_t id, const char* what) {
  const auto at = std::lower_bound(items.begin(), items.end(), id,
                                   [](const auto& item, std::int32_t wanted) { return item.id < wanted; });
  if (at == items.end() || at->id != id)
    throw InvalidInput("skeleton graph: there is no " + std::string(what) + " " + std::to_string(id));
  return *at;
}

std::optional<std::string> fault_of(const SkeletonGraph& graph, const SkeletonEdge& e) {
  const std::string name = "edge " + std::to_string(e.id);
  const auto known = [&](std::int32_t id) {
    const auto at =
        std::lower_bound(graph.nodes.begin(), graph.nodes.end(), id,
                         [](const SkeletonNode& n, std::int32_t wanted) { return n.id < wanted; });
    return at != graph.nodes.end() && at->id == id;
  };
  if (!known(e.from) || !known(e.to)) return name + " names a node that is not there";
  if (e.points.size() < 2 || e.radius_mm.size() != e.points.size())
    return name + " has " + std::to_string(e.points.size()) + " points and " +
           std::to_string(e.radius_mm.size()) + " radii; it needs two or more, as many of each";
  for (std::size_t i = 0; i < e.points.size(); ++i) {
    if (!e.points[i].allFinite()) return name + " has a point that is not finite";
    if (!(e.radius_mm[i] >= 0.0) || !std::isfinite(e.radius_mm[i])) return name + " has a radius below 0";
    if (i > 0 && !((e.points[i] - e.points[i - 1]).norm() > 0.0)) return name + " stands still";
  }
  if ((node(graph, e.from).position - e.points.front()).norm() > node_tolerance_mm ||
      (node(graph, e.to).position - e.points.back()).norm() > node_tolerance_mm)
    return name + " does not begin and end at its nodes";
  return std::nullopt;
}

}  // namespace

SkeletonGraph skeleton_graph(const Thinned& skeleton, const core::TaskContext& task) {
  task.throw_if_cancelled();
  if (skeleton.voxels.size() != skeleton.distance_mm.size())
    throw InvalidInput("skeleton graph: " + std::to_string(skeleton.voxels.size()) + " voxels, but " +
                       std::to_string(skeleton.distance_mm.size()) + " distances");
  std::size_t inside = 0;
  for (const std::uint8_t v : skeleton.mask.voxels) inside += v != 0 ? 1U : 0U;
  if (inside != skeleton.voxels.size())
    throw InvalidInput("skeleton graph: the mask has " + std::to_string(inside) + " voxels, but " +
                       std::to_string(skeleton.voxels.size()) + " are listed");
  const SkeletonVoxels voxels = detail::neighbours_of(skeleton);
  task.throw_if_cancelled();
  return GraphMaker(skeleton, voxels).make();
}

const SkeletonNode& node(const SkeletonGraph& graph, std::int32_t id) {
  return by_id(graph.nodes, id, "node");
}
const SkeletonEdge& edge(const SkeletonGraph& graph, std::int32_t id) {
  return by_id(graph.edges, id, "edge");
}
double length_mm(const SkeletonEdge& edge) {
  return geometry::length(edge.points);
}

std::int64_t component_count(const SkeletonGraph& graph) {
  std::map<std::int32_t, std::int32_t> root;
  for (const SkeletonNode& n : graph.nodes) root[n.id] = n.id;
  const auto find = [&](std::int32_t a) {
    while (root.at(a) != a) a = root[a] = root.at(root.at(a));
    return a;
  };
  auto count = static_cast<std::int64_t>(graph.nodes.size());
  for (const SkeletonEdge& e : graph.edges) {
    const std::int32_t a = find(e.from), b = find(e.to);
    if (a == b) continue;
    root[a] = b;
    --count;
  }
  return count;
}

std::int64_t loop_count(const SkeletonGraph& graph) {
  return static_cast<std::int64_t>(graph.edges.size()) - static_cast<std::int64_t>(graph.nodes.size()) +
         component_count(graph);
}

std::optional<std::string> find_fault(const SkeletonGraph& graph) {
  for (std::size_t i = 0; i < graph.nodes.size(); ++i) {
    const SkeletonNode& n = graph.nodes[i];
    if (i > 0 && n.id <= graph.nodes[i - 1].id)
      return "the nodes' ids do not ascend at " + std::to_string(n.id);
    if (!n.position.allFinite()) return "node " + std::to_string(n.id) + " is not finite";
  }
  for (std::size_t i = 0; i < graph.edges.size(); ++i) {
    if (i > 0 && graph.edges[i].id <= graph.edges[i - 1].id)
      return "the edges' ids do not ascend at " + std::to_string(graph.edges[i].id);
    if (auto fault = fault_of(graph, graph.edges[i])) return fault;
  }
  const SkeletonGraph anew = GraphEditor(graph).graph();
  for (std::size_t i = 0; i < graph.nodes.size(); ++i)
    if (anew.nodes[i].kind != graph.nodes[i].kind)
      return "the kind of node " + std::to_string(graph.nodes[i].id) + " is not what its edges make it";
  return std::nullopt;
}

}  // namespace ostia::centerline
