#pragma once
/// \file Networks of vessels as plain arrays, for trees of millions of segments. See
/// docs/methods/vessel-graph.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vec.h"

#include <cstdint>
#include <span>
#include <vector>

namespace ostia::geometry {

/// A straight piece of a vessel between two points, a truncated cone. It has its own radius at either end:
/// at a fork the child's radius is not its parent's. Lengths in mm.
struct GraphEdge {
  std::int32_t from = 0, to = 0;  ///< indices into the points; proximal, distal
  double radius_from = 0.0, radius_to = 0.0;
};

/// A directed graph: a tree, several trees, or one with loops and several parents ([Luboz 2.1]). In world
/// space (LPS, mm), or in the tree's own space where it was grown.
struct VesselGraph {
  std::vector<Vec3> points;
  std::vector<GraphEdge> edges;
  /// What the data file calls each edge (its line, its cell's id, its sample's id); empty: its index.
  std::vector<std::int64_t> references;
};

/// The edges at each point, both arriving and leaving, in the order of their indices. 8 bytes a point and 4
/// an edge for each of the two. Throws InvalidInput for an edge that names a point that is not there.
class GraphIncidence {
 public:
  explicit GraphIncidence(const VesselGraph& graph);
  std::span<const std::int32_t> leaving(std::int32_t point) const;   ///< edges whose `from` it is
  std::span<const std::int32_t> arriving(std::int32_t point) const;  ///< edges whose `to` it is

 private:
  std::vector<std::int64_t> first_leaving_, first_arriving_;
  std::vector<std::int32_t> leaving_, arriving_;
};

/// A maximal chain of edges, each with one edge before and one after it but at the chain's ends: what lies
/// between two forks, roots or ends. A circle without any fork begins at its point of the lowest index.
struct GraphBranch {
  std::vector<std::int32_t> edges;  ///< proximal first
};
/// Every edge is of one branch. Branches are in the order of their first edges' indices.
std::vector<GraphBranch> branches(const VesselGraph& graph, const GraphIncidence& incidence);

}  // namespace ostia::geometry
