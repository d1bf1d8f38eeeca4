#pragma once
/// \file Edges of a network by number.

#include "ostia/geometry/vessel_graph.h"

#include <cstdint>

namespace ostia::analysis {

inline const geometry::GraphEdge& edge_at(const geometry::VesselGraph& graph, std::int32_t edge) {
  return graph.edges[static_cast<std::size_t>(edge)];
}

}  // namespace ostia::analysis
