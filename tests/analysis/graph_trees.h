#pragma once
/// \file Trees whose measures are known beforehand.

#include "ostia/geometry/vessel_graph.h"

#include <cmath>
#include <initializer_list>
#include <vector>

namespace ostia::analysis::testing {

using geometry::GraphEdge;
using geometry::Vec3;
using geometry::VesselGraph;

struct Piece {
  std::int32_t from, to;
  double radius_from, radius_to;
};
inline VesselGraph graph_of(std::vector<Vec3> points, const std::vector<Piece>& pieces) {
  VesselGraph graph;
  graph.points = std::move(points);
  for (const Piece& p : pieces) graph.edges.push_back({p.from, p.to, p.radius_from, p.radius_to});
  return graph;
}

/// A line along +z of `count` edges of length 1, radius 0.1.
inline VesselGraph line_of(std::int32_t count) {
  VesselGraph graph;
  graph.points.emplace_back(0.0, 0.0, 0.0);
  for (std::int32_t i = 0; i < count; ++i) {
    graph.points.emplace_back(0.0, 0.0, i + 1.0);
    graph.edges.push_back({i, i + 1, 0.1, 0.1});
  }
  return graph;
}

/// A binary tree in the plane of `levels` levels; a branch of level 0 (the root's) has length 1 and radius 1,
/// each further level `length` times the length and `radius` times the radius. It opens by 90 degrees.
inline VesselGraph binary_tree(int levels, double length = 0.45, double radius = 0.7) {
  VesselGraph graph;
  graph.points = {Vec3::Zero(), Vec3::UnitX()};
  graph.edges.push_back({0, 1, 1.0, 1.0});
  std::vector<std::int32_t> front{0};
  for (int level = 1; level < levels; ++level) {
    std::vector<std::int32_t> next;
    for (const std::int32_t e : front) {
      const GraphEdge parent = graph.edges[static_cast<std::size_t>(e)];
      const Vec3 at = graph.points[static_cast<std::size_t>(parent.to)];
      const Vec3 along = (at - graph.points[static_cast<std::size_t>(parent.from)]) * length;
      for (const double side : {-1.0, 1.0}) {
        const double c = std::sqrt(0.5), s = side * std::sqrt(0.5);
        graph.points.push_back(at + Vec3(c * along.x() - s * along.y(), s * along.x() + c * along.y(), 0.0));
        next.push_back(static_cast<std::int32_t>(graph.edges.size()));
        graph.edges.push_back({parent.to, static_cast<std::int32_t>(graph.points.size()) - 1,
                               parent.radius_to * radius, parent.radius_to * radius});
      }
    }
    front = next;
  }
  return graph;
}

}  // namespace ostia::analysis::testing
