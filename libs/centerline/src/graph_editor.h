#pragma once
/// \file A skeleton's graph while it is changed.

#include "ostia/centerline/skeleton_graph.h"

#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

namespace ostia::centerline::detail {

// A place on the graph: a node, or a point of an edge between its points `segment` and `segment + 1`.
struct GraphPlace {
  bool at_node = false;
  std::int32_t id = 0;  // of the node or the edge
  std::size_t segment = 0;
  double t = 0.0;
  Vec3 point = Vec3::Zero();
  double distance_mm = 0.0;
};

// Throws InvalidInput with the first fault.
void require_sound(const SkeletonGraph& graph, const char* what);
void require(bool good, const char* what, const char* name, double value, const char* allowed);
std::string text(const Vec3& place);

// The straight line of least squares over the outermost `length_mm` of an edge, at its first point (or last).
struct LineEnd {
  Vec3 point = Vec3::Zero();    // of the straight line, where the edge ends
  Vec3 outward = Vec3::Zero();  // unit; zero where the edge turns back on itself
};
LineEnd line_end(const SkeletonEdge& edge, bool at_first, double length_mm);

// The straight way between two places with both ends, its points as dense as those of lines that were found:
// smoothing would make a swing of two points.
std::vector<Vec3> straight_way(const Vec3& from, const Vec3& to);

// Nodes and edges by id, and which edges meet at each node (an edge from a node to itself twice).
class GraphEditor {
 public:
  explicit GraphEditor(const SkeletonGraph& graph);

  const std::map<std::int32_t, SkeletonNode>& nodes() const { return nodes_; }
  const std::map<std::int32_t, SkeletonEdge>& edges() const { return edges_; }
  std::size_t degree(std::int32_t node) const;
  const std::multiset<std::int32_t>& edges_at(std::int32_t node) const { return incident_.at(node); }
  SkeletonNode& node(std::int32_t id) { return nodes_.at(id); }

  std::int32_t add_node(const Vec3& position, double radius_mm);
  std::int32_t add_edge(std::int32_t from, std::int32_t to, std::vector<Vec3> points,
                        std::vector<double> radius_mm);
  void replace_line(std::int32_t edge, std::vector<Vec3> points, std::vector<double> radius_mm);
  void reverse(std::int32_t edge);
  void remove_edge(std::int32_t edge);
  void remove_node(std::int32_t node);  // one without edges
  // Two edges at a node of degree two become one (the lower id stays, and its direction); returns its id, or
  // -1 where there is nothing to join.
  std::int32_t join_at(std::int32_t node);
  // Cuts an edge at a place within it; the part before keeps the id. Returns the new node.
  std::int32_t split(const GraphPlace& place);
  // Gives the edge an end of its own at its `from` (or `to`).
  void detach(std::int32_t edge, bool at_from);

  GraphPlace closest(const Vec3& place, double snap_mm) const;
  GraphPlace closest_end(const Vec3& place) const;  // id -1 where there is none

  // With the kinds anew.
  SkeletonGraph graph() const;

 private:
  std::map<std::int32_t, SkeletonNode> nodes_;
  std::map<std::int32_t, SkeletonEdge> edges_;
  std::map<std::int32_t, std::multiset<std::int32_t>> incident_;
  std::int32_t next_node_ = 0, next_edge_ = 0;
};

}  // namespace ostia::centerline::detail
