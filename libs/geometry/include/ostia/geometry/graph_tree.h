#pragma once
/// \file Between networks as plain arrays and trees of named vessels.

#include "ostia/geometry/vessel_graph.h"
#include "ostia/geometry/vessel_tree.h"

namespace ostia::geometry {

/// Every step of every axis is a segment; the ends of axes are their nodes, one point each. The references
/// are the ids of the tree's segments. Throws InvalidInput for a segment that names a node which is not
/// there, or has fewer than two points or not a radius for each.
VesselGraph graph_of(const VesselTree& tree);

/// Each branch is a segment, in the order of `branches`, its axis completed; nodes are the branches' ends.
/// A vessel for each end, from its root to it, `vessel_1` and so on in the order of the ends' points. Where a
/// radius jumps between two edges of a branch the axis has the mean of both; at forks each segment keeps its
/// own. Throws InvalidInput unless the graph is sound as a tree or several ones (see require_sound).
VesselTree tree_of(const VesselGraph& graph, const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
