#pragma once
/// \file What counting a network's faults and repairing them have in common.

#include "ostia/geometry/vessel_graph.h"

#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// Both points are there.
inline bool within(const VesselGraph& graph, const GraphEdge& edge) {
  const auto count = static_cast<std::int64_t>(graph.points.size());
  return edge.from >= 0 && edge.from < count && edge.to >= 0 && edge.to < count;
}

/// Throws InvalidInput where 32 bits do not count the points or the edges.
void check_size(const VesselGraph& graph);

std::vector<bool> finite_points(const VesselGraph& graph);

/// The first of all points at the very place of each (0 and -0 are one place); itself where not `finite`.
std::vector<std::int32_t> first_at_its_place(const std::vector<Vec3>& points,
                                             const std::vector<bool>& finite);

/// The first of all edges between the two points of each, in either direction; itself for those from a point
/// to itself or out of range.
std::vector<std::int32_t> first_between_its_points(const VesselGraph& graph);

/// How many edges leave and reach each point.
struct Degrees {
  std::vector<std::int32_t> leaving, arriving;
};
Degrees degrees_of(const VesselGraph& graph);

}  // namespace ostia::geometry
