#pragma once
/// \file Directions of a network's segments.

#include "ostia/geometry/graph_repair.h"

namespace ostia::geometry {

/// Turns segments as `repaired` says; how many. The graph's indices must be in range, its points finite.
std::size_t turn_from_roots(VesselGraph& graph, const GraphRepairOptions& options);

}  // namespace ostia::geometry
