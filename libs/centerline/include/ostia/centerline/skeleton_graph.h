#pragma once
/// \file Skeletons as graphs: nodes, and edges with a radius along them. Loops, several roots and several
/// components are allowed.

#include "ostia/centerline/thinning.h"
#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::centerline {

using geometry::Vec3;

enum class SkeletonNodeKind {
  point,        ///< no edge
  end,          ///< one edge
  passage,      ///< two: a root or a cut within a line
  junction,     ///< three or more
  loop_anchor,  ///< where a closed line without junction begins and ends
};

struct SkeletonNode {
  std::int32_t id = 0;
  Vec3 position = Vec3::Zero();  ///< mm, LPS
  SkeletonNodeKind kind = SkeletonNodeKind::point;
  double radius_mm = 0.0;
};

/// A line between two nodes, which may be the same one. The first and the last point are the nodes'.
struct SkeletonEdge {
  std::int32_t id = 0;
  std::int32_t from = 0, to = 0;  ///< node ids; the flow's direction in an oriented graph
  std::vector<Vec3> points;       ///< mm, LPS; two or more, neighbours apart
  std::vector<double> radius_mm;  ///< one a point
};

/// Ids are stable and never used again within a chain of commands; they are not indices. Ascending.
struct SkeletonGraph {
  std::vector<SkeletonNode> nodes;
  std::vector<SkeletonEdge> edges;
  bool oriented = false;  ///< `oriented` gave the edges their direction, and nothing was changed since
};

/// The graph of a skeleton of curves. Voxels with three neighbours or more that touch each other are one
/// junction, at their mean; where such a cluster holds loops itself, its voxels become nodes and the shortest
/// lines that span the loops stay (cycles modulo triangles, over the integers modulo 2), so that components
/// and loops are the skeleton's. Radii are the distances to the background less half the smallest spacing, a
/// first guess. Throws InvalidInput where the numbers of voxels and distances differ or a voxel could still
/// be removed (the mask is not thin), GeometryError where the skeleton holds a closed surface (a cavity of
/// the object: `fill_cavities`), Cancelled.
SkeletonGraph skeleton_graph(const Thinned& skeleton, const core::TaskContext& task = core::no_task());

const SkeletonNode& node(const SkeletonGraph& graph, std::int32_t id);  ///< throws InvalidInput
const SkeletonEdge& edge(const SkeletonGraph& graph, std::int32_t id);  ///< throws InvalidInput
double length_mm(const SkeletonEdge& edge);
std::int64_t component_count(const SkeletonGraph& graph);
std::int64_t loop_count(const SkeletonGraph& graph);  ///< independent: edges - nodes + components
/// What is wrong with the graph (repeated or unknown ids, lines that are incomplete, stand still, are not
/// finite or miss their nodes by 1e-6 mm, radii below 0, kinds that the edges contradict); nothing if sound.
std::optional<std::string> find_fault(const SkeletonGraph& graph);

/// A tree of vessels and what had to be opened for it.
struct SkeletonTree {
  geometry::VesselTree tree;
  std::vector<std::int32_t> opened_edges;  ///< ids: closed loops; in the tree they end beside their end node
  std::vector<std::int32_t> edge_of_segment;  ///< one a segment of the tree, in its order
};
/// The oriented graph as trees, one a root: each node's parent is the edge on its shortest way from a root,
/// and other edges into it end in a node of their own at the same place. One vessel an end, from its root,
/// named vessel_1, vessel_2, ...; points at equal steps no longer than `step_mm` ((0, 10]). Nodes without
/// edges are left out. Throws InvalidInput for a graph that is not oriented or has a fault.
SkeletonTree vessel_tree(const SkeletonGraph& graph, double step_mm = 0.5);

}  // namespace ostia::centerline
