#pragma once
/// \file A faulty network of vessels made fit for use, and put in order.

#include "ostia/geometry/graph_faults.h"

namespace ostia::geometry {

struct GraphRepairOptions {
  /// Points no further apart than this are one, mm; 0: those at the very same place alone. >= 0.
  double merge_within_mm = 0.0;
  /// Where the parts begin: each the point nearest to one of these; parts without one are as the rest.
  std::vector<Vec3> roots;
  /// No segment is turned but those of parts for which `roots` has a place: where vessels flow together.
  bool keep_directions = false;
};
void validate(const GraphRepairOptions& options);

/// One kind of thing that was done.
struct GraphRepairStep {
  std::string what;       ///< key for machines: `zero_length_dropped`
  std::size_t count = 0;  ///< > 0
  std::string text;       ///< for a person: "segments without length dropped: 3"
};

struct RepairedGraph {
  VesselGraph graph;                   ///< references are always filled: as they were, or the old indices
  std::vector<GraphRepairStep> steps;  ///< in the order of work; empty when nothing was wrong
  GraphFaults left;                    ///< loops and several parts stay; radii where a part has none
};

/// In this order: drops segments that name points which are not there or not finite; joins points at one
/// place (0 and -0 are one; the first of them keeps its place); drops segments without length; of segments
/// between the same two points, in either direction, keeps the first, with the radii it lacks from the next
/// one that has them; fills radii that are missing, zero or negative from their neighbours (see
/// docs/methods/vessel-graph.md); turns the segments of each part that is no rooted tree
/// away from its root, the end of greatest radius (of a part with loops only where it has no root, or one was
/// given); puts the segments in order, each behind those that reach its first point, drops points of no
/// segment and numbers the rest as they come. Throws InvalidInput (options; nothing left), Cancelled.
RepairedGraph repaired(VesselGraph graph, const GraphRepairOptions& options = {},
                       const core::TaskContext& task = core::no_task());

/// The last step alone: true where that changed anything. The graph's indices must be in range.
bool put_in_order(VesselGraph& graph);

}  // namespace ostia::geometry
