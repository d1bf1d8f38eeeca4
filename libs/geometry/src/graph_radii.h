#pragma once
/// \file Radii that a network's file does not have.

#include "ostia/geometry/vessel_graph.h"

namespace ostia::geometry {

/// Radii that are missing, zero or negative, from their neighbours; how many segments had one and have none
/// any more. Round by round: each end of a segment takes the mean of the radii known at its point, or else
/// the one of its segment's other end, until nothing changes. The graph's indices must be in range.
std::size_t fill_radii(VesselGraph& graph, const core::TaskContext& task);

}  // namespace ostia::geometry
