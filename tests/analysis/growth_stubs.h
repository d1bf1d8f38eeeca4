#pragma once
/// \file Scanned vessels from which trees grow.

#include "ostia/geometry/vessel_graph.h"

#include <cmath>

namespace ostia::analysis::testing {

/// Short vessels on the outer surface of the default shell that point inwards, spread about it.
inline geometry::VesselGraph stubs(int count, double radius) {
  geometry::VesselGraph graph;
  for (int i = 0; i < count; ++i) {
    const double phi = i * 2.399963, z = 8.0 + 65.0 * (i + 0.5) / count;
    const double r = 40.0 * std::sqrt(1.0 - z * z / 8100.0);
    for (const double scale : {1.03, 0.95})
      graph.points.emplace_back(scale * r * std::cos(phi), scale * r * std::sin(phi), z);
    graph.edges.push_back({2 * i, 2 * i + 1, radius, radius});
  }
  return graph;
}

}  // namespace ostia::analysis::testing
