#pragma once
/// \file Networks whose surfaces are known beforehand.

#include "ostia/geometry/vessel_graph.h"

#include <cmath>
#include <numbers>
#include <vector>

namespace ostia::reconstruction::testing {

using geometry::Vec3;
using geometry::VesselGraph;

/// A straight vessel along x.
inline VesselGraph tube(double length, double radius, int segments = 1) {
  VesselGraph graph;
  for (int i = 0; i <= segments; ++i) graph.points.emplace_back(length * i / segments, 0.0, 0.0);
  for (int i = 0; i < segments; ++i) graph.edges.push_back({i, i + 1, radius, radius});
  return graph;
}

/// A ring in the plane z = 0.
inline VesselGraph torus(double major, double minor, int segments) {
  VesselGraph graph;
  for (int i = 0; i < segments; ++i) {
    const double t = 2.0 * std::numbers::pi * i / segments;
    graph.points.emplace_back(major * std::cos(t), major * std::sin(t), 0.0);
    graph.edges.push_back({i, (i + 1) % segments, minor, minor});
  }
  return graph;
}

inline Vec3 direction(double degrees, double roll_degrees = 0.0) {
  const double a = degrees * std::numbers::pi / 180.0, b = roll_degrees * std::numbers::pi / 180.0;
  return {std::cos(a), std::sin(a) * std::cos(b), std::sin(a) * std::sin(b)};
}

struct Child {
  Vec3 direction;  ///< unit
  double radius = 1.0, length = 10.0;
};

/// A vessel that arrives at the origin along x, and its children.
inline VesselGraph fork(double radius, double length, const std::vector<Child>& children) {
  VesselGraph graph;
  graph.points = {{-length, 0.0, 0.0}, {0.0, 0.0, 0.0}};
  graph.edges = {{0, 1, radius, radius}};
  for (const Child& child : children) {
    graph.points.push_back(child.length * child.direction);
    graph.edges.push_back(
        {1, static_cast<std::int32_t>(graph.points.size() - 1), child.radius, child.radius});
  }
  return graph;
}

/// How long a child must be for its wall to leave those of its neighbours: twice over, and some.
inline double clear_length(double degrees, double radius) {
  return radius * (4.0 + 2.0 / std::sin(std::min(90.0, degrees) * std::numbers::pi / 360.0));
}

/// A vessel that goes on straight, with a child of `ratio` at this angle and roll about the trunk.
inline VesselGraph side_branch(double degrees, double ratio, double roll_degrees = 0.0) {
  const double bend = std::min(degrees, 180.0 - degrees);
  const double length = clear_length(bend, 1.0);
  return fork(1.0, length, {{Vec3::UnitX(), 1.0, length}, {direction(degrees, roll_degrees), ratio, length}});
}

/// Two equal children that make this angle with each other.
inline VesselGraph y_fork(double degrees, double ratio) {
  const double length = clear_length(degrees, 1.0);
  return fork(1.0, length,
              {{direction(0.5 * degrees), ratio, length}, {direction(-0.5 * degrees), ratio, length}});
}

}  // namespace ostia::reconstruction::testing
