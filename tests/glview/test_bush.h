#pragma once
/// \file A bush of any number of segments that fills a ball, the same on every machine.

#include "ostia/geometry/vessel_graph.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <random>

namespace ostia::glview {

/// Every end forks in turn; radii by Murray's law, lengths as those of a bush that fills 40 mm.
inline geometry::VesselGraph test_bush(std::int32_t segments, std::uint32_t seed = 7) {
  std::mt19937 random(seed);
  const auto uniform = [&random] { return 2.0 * (static_cast<double>(random()) / 4294967295.0) - 1.0; };
  geometry::VesselGraph graph;
  graph.points = {geometry::Vec3(0, 0, -40), geometry::Vec3(0, 0, -20)};
  graph.edges = {{0, 1, 2.0, 2.0}};
  for (std::int32_t parent = 0; static_cast<std::int32_t>(graph.edges.size()) < segments; ++parent) {
    const geometry::GraphEdge from = graph.edges[static_cast<std::size_t>(parent)];
    const geometry::Vec3 start = graph.points[static_cast<std::size_t>(from.to)],
                         before = start - graph.points[static_cast<std::size_t>(from.from)];
    for (int child = 0; child < 2; ++child) {
      const double share = child == 0 ? 0.6 : 0.4;  // of the flow
      geometry::Vec3 way = before.normalized() + geometry::Vec3(uniform(), uniform(), uniform());
      const double radius = from.radius_to * std::cbrt(share);
      way *= 8.0 * std::pow(radius, 0.8) / std::max(0.1, way.norm());
      if ((start + way).norm() > 40.0) way = -way;
      graph.points.push_back(start + way);
      graph.edges.push_back({from.to, static_cast<std::int32_t>(graph.points.size()) - 1, radius, radius});
    }
  }
  return graph;
}

}  // namespace ostia::glview
