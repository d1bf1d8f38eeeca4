#pragma once
/// \file What is wrong with a network of vessels, and what there is to say about it.

#include "ostia/geometry/vessel_graph.h"

#include <string>
#include <string_view>

namespace ostia::geometry {

enum class GraphFaultKind {
  index_out_of_range,  ///< segments that name a point that is not there
  non_finite_point,    ///< points with NaN or infinity
  zero_length,         ///< segments between a point and itself, or two points at one place
  missing_radius,      ///< segments with a radius at an end that is not a finite number
  negative_radius,
  zero_radius,
  duplicate_point,    ///< points at the very place of one before
  duplicate_segment,  ///< segments between the two points of one before, whichever way they run
  loose_point,        ///< points of no segment
  several_parents,    ///< points where more than one segment arrives; from here on no faults of a network,
  cycle,              ///< but of a tree: segments that close a loop, in the order of their indices,
  several_roots,      ///< points that segments leave and none reaches, beyond one for each part,
  no_root,            ///< parts without such a point,
  several_parts       ///< and parts beyond the first
};
/// For a machine: `zero_length`.
std::string_view name_of(GraphFaultKind kind);

/// All faults of one kind.
struct GraphFault {
  GraphFaultKind kind = GraphFaultKind::zero_length;
  std::size_t count = 0;
  /// The first few places: indices of edges, or of points where the fault is one of points.
  std::vector<std::int32_t> edges, points;
};

struct GraphFaults {
  std::vector<GraphFault> found;  ///< in the order of the kinds; those that are there
  std::size_t count(GraphFaultKind kind) const;
  bool sound() const;        ///< nothing is wrong with it as a network; loose points do no harm
  bool sound_tree() const;   ///< nor as one tree
  bool sound_trees() const;  ///< nor as a tree or several ones
};

/// Counts and places all faults, on the graph as it stands: whatever indices and numbers it has. Edges out
/// of range are left out of what is said about points and parts. Throws Cancelled.
GraphFaults find_faults(const VesselGraph& graph, const core::TaskContext& task = core::no_task());

/// "3 segments of zero length (line 17, line 20, line 44)"; segments by the graph's references, called
/// `reference_name`, or by index without references; points by index and, with references, by the segment
/// that reaches them or else the first that leaves them: "point 6 of line 7".
std::string text_of(const GraphFault& fault, const VesselGraph& graph,
                    const std::string& reference_name = "segment");
/// All of them in one line, "none" without any.
std::string summary(const GraphFaults& faults, const VesselGraph& graph,
                    const std::string& reference_name = "segment");
/// Throws InvalidInput that names `what` and its faults, and says that `ostia convert --repair` mends them,
/// unless the graph is sound (`tree`: as a tree or several ones). Places as in text_of.
void require_sound(const VesselGraph& graph, const std::string& what, bool tree,
                   const core::TaskContext& task = core::no_task(),
                   const std::string& reference_name = "segment");

/// What there is in a network. Edges out of range are left out.
struct GraphFacts {
  std::size_t points = 0, segments = 0, branches = 0;
  std::size_t parts = 0;  ///< connected ones, of segments
  std::size_t roots = 0, ends = 0;
  std::size_t forks = 0;                                  ///< points that two or more segments leave
  std::size_t trifurcations = 0;                          ///< of these, those with three or more
  std::size_t joins = 0;                                  ///< points where more than one segment arrives
  std::size_t loops = 0;                                  ///< independent ones: segments - points + parts
  double length_mm = 0.0;                                 ///< of the segments between finite points
  double least_radius_mm = 0.0, largest_radius_mm = 0.0;  ///< of the positive ones; 0 without any
  Box3 box;                                               ///< of the finite points
};
GraphFacts facts_of(const VesselGraph& graph, const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
