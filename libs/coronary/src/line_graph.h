#pragma once
/// \file Lines of a skeleton while they are joined and parted.

#include "ostia/centerline/skeleton_graph.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <set>
#include <vector>

namespace ostia::coronary {

using geometry::Vec3;

/// Ids are those of the skeleton's graph, and are never used again.
class LineGraph {
 public:
  struct Node {
    Vec3 at = Vec3::Zero();
    double radius_mm = 0.0;
  };
  struct Line {
    std::int32_t from = 0, to = 0;
    std::vector<Vec3> points;
    std::vector<double> radius_mm;
  };
  explicit LineGraph(const centerline::SkeletonGraph& graph);

  const std::map<std::int32_t, Node>& nodes() const { return nodes_; }
  const std::map<std::int32_t, Line>& lines() const { return lines_; }
  const std::multiset<std::int32_t>& lines_at(std::int32_t node) const { return at_.at(node); }
  std::size_t degree(std::int32_t node) const { return at_.at(node).size(); }
  std::int32_t other_end(std::int32_t line, std::int32_t node) const;

  std::int32_t add_node(const Node& node);
  std::int32_t add_line(std::int32_t from, std::int32_t to, std::vector<Vec3> points,
                        std::vector<double> radius_mm);
  void remove_line(std::int32_t id);  ///< its nodes stay
  /// A node at an inner point of a line, which becomes two.
  std::int32_t split(std::int32_t line, std::size_t point);
  /// Two ends beside each other at an inner point of a line.
  void cut(std::int32_t line, std::size_t point);
  /// Lines that meet by themselves become one, but not at nodes to `keep`; nodes without lines go.
  void tidy(const std::set<std::int32_t>& keep);

  /// Lengths of the shortest ways along the lines to all nodes that they lead to, and the line by which each
  /// is reached (-1 at the start).
  struct Reach {
    double mm = 0.0;
    std::int32_t line = -1;
  };
  std::map<std::int32_t, Reach> reach(std::int32_t from) const;
  /// The lowest node of the part that each node belongs to.
  std::map<std::int32_t, std::int32_t> parts() const;

  centerline::SkeletonGraph graph() const;

 private:
  std::map<std::int32_t, Node> nodes_;
  std::map<std::int32_t, Line> lines_;
  std::map<std::int32_t, std::multiset<std::int32_t>> at_;
  std::int32_t next_node_ = 0, next_line_ = 0;
};

double length_mm(const LineGraph::Line& line);
/// Unit, from the inside of a line to its first (or last) point and beyond, over so much of its length.
Vec3 outward(const LineGraph::Line& line, bool at_first, double over_mm);
/// Mean radius between two distances from the first (or last) point.
double mean_radius(const LineGraph::Line& line, bool at_first, double from_mm, double to_mm);
/// Points about 0.5 mm apart from one place to another, both included.
std::vector<Vec3> straight_points(const Vec3& from, const Vec3& to);

}  // namespace ostia::coronary
