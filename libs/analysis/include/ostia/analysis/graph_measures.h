#pragma once
/// \file Lengths, areas, volumes and totals of trees of vessels as plain arrays. See
/// docs/methods/tree-measures.md. All take time and memory in proportion to the tree, and none calls itself:
/// a tree may be a million deep.

#include "ostia/geometry/vessel_graph.h"

#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::analysis {

/// A truncated cone: lateral area pi (a + b) s with the slant height s, volume pi L (a^2 + a b + b^2) / 3.
struct ConeMeasure {
  double length_mm = 0.0;
  double area_mm2 = 0.0;  ///< without its two ends
  double volume_mm3 = 0.0;
};
ConeMeasure measure_cone(double length_mm, double radius_from_mm, double radius_to_mm);
ConeMeasure measure_segment(const geometry::VesselGraph& graph, std::int32_t edge);

/// How a rooted tree, or several, hang together: what everything else here walks along.
struct TreeLinks {
  std::vector<std::int32_t> parent;     ///< of each edge; -1 at a root
  std::vector<std::int32_t> outward;    ///< all edges, each behind its parent
  std::vector<std::int32_t> branch_of;  ///< of each edge, into `branches`
  std::vector<geometry::GraphBranch> branches;
  std::vector<std::int32_t> branch_parent;     ///< of each branch; -1 at a root
  std::vector<std::int32_t> branches_outward;  ///< all branches, each behind its parent
};
/// Throws InvalidInput that names the place where two vessels join or a loop closes, and for points out of
/// range, no segments, and places or radii that are not finite or radii below 0; Cancelled.
TreeLinks link_tree(const geometry::VesselGraph& graph, const geometry::GraphIncidence& incidence,
                    const core::TaskContext& task = core::no_task());

/// All that hangs on an edge, itself included.
struct SubtreeTotals {
  double length_mm = 0.0, area_mm2 = 0.0, volume_mm3 = 0.0;
  std::int32_t segments = 0;
  std::int32_t ends = 0;  ///< edges with nothing behind them
};
/// For each edge.
std::vector<SubtreeTotals> subtree_totals(const geometry::VesselGraph& graph, const TreeLinks& links);

/// A branch as a whole: what lies between two forks, which morphometry calls a segment.
struct BranchMeasure {
  ConeMeasure sum;           ///< over its edges
  double chord_mm = 0.0;     ///< between its ends
  double diameter_mm = 0.0;  ///< mean along it, weighted by length
  double radius_from_mm = 0.0, radius_to_mm = 0.0;
};
/// For each branch of the links.
std::vector<BranchMeasure> measure_branches(const geometry::VesselGraph& graph, const TreeLinks& links);

/// Distances along a tree: built once, then each question takes the number of edges on the way.
class TreeDistances {
 public:
  TreeDistances(const geometry::VesselGraph& graph, const TreeLinks& links);
  double from_root_mm(std::int32_t point) const { return from_root_[static_cast<std::size_t>(point)]; }
  /// Between two points, through where their ways to the root meet. None: they are of two trees.
  std::optional<double> between_mm(std::int32_t a, std::int32_t b) const;

 private:
  std::vector<double> from_root_;
  std::vector<std::int32_t> before_;  ///< the point before each; -1 at a root
  std::vector<std::int32_t> level_;   ///< edges from the root
};

}  // namespace ostia::analysis
