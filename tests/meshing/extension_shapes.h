#pragma once
/// \file Open tubes with a section of any shape, for flow extensions.

#include "shape_tree.h"

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/meshing/clip.h"

#include <cmath>
#include <cstdint>
#include <functional>
#include <numbers>
#include <utility>

namespace ostia::meshing {

/// Radius 1.5 mm.
inline geometry::Vec3 circle(double a) {
  return {1.5 * std::cos(a), 1.5 * std::sin(a), 0.0};
}
/// `ratio` times as wide as high, half axes of `ratio` and 1 mm.
inline geometry::Vec3 ellipse(double a, double ratio) {
  return {ratio * std::cos(a), std::sin(a), 0.0};
}
/// A bar of 3:1 bent over, hollow on one side.
inline geometry::Vec3 kidney(double a) {
  const double x = 3.0 * std::cos(a);
  return {x, std::sin(a) + 0.14 * x * x - 0.6, 0.0};
}

struct OpenTube {
  geometry::TriMesh mesh;
  geometry::VesselTree tree;
};

/// Along +z from 0, with `around` points a ring; the far end stands `slope` mm higher a mm of x.
inline OpenTube tube_of_section(const std::function<geometry::Vec3(double)>& section, int around,
                                double length, double radius, double slope = 0.0) {
  OpenTube tube;
  const double step = 2.0 * std::numbers::pi / around;
  const double edge = (section(step) - section(0.0)).norm();
  const int rows = std::max(4, static_cast<int>(length / (0.87 * edge)));
  for (int k = 0; k <= rows; ++k)
    for (int i = 0; i < around; ++i) {
      geometry::Vec3 p = section(step * (i + 0.5 * (k % 2)));
      const double share = static_cast<double>(k) / rows;
      p.z() = share * (length + slope * p.x());
      tube.mesh.points.push_back(p);
    }
  for (int k = 0; k < rows; ++k)
    for (int i = 0; i < around; ++i) {
      const int j = (i + 1) % around, below = k * around, above = below + around;
      const bool ahead = k % 2 == 0;
      tube.mesh.triangles.push_back({below + i, below + j, ahead ? above + i : above + j});
      if (ahead)
        tube.mesh.triangles.push_back({below + j, above + j, above + i});
      else
        tube.mesh.triangles.push_back({below + i, above + j, above + i});
    }
  tube.tree = tree_of(geometry::straight_tube(length, radius));
  return tube;
}

/// An arc of a ring in the xy plane, from angle 0.
inline OpenTube ring_arc(double ring_radius, double radius, double degrees, int around = 32) {
  geometry::AnalyticShape shape;
  geometry::AnalyticTube tube{"arc", {}};
  constexpr int steps = 400;
  for (int i = 0; i <= steps; ++i) {
    const double a = degrees * std::numbers::pi / 180.0 * i / steps;
    tube.axis.points.emplace_back(ring_radius * std::cos(a), ring_radius * std::sin(a), 0.0);
    tube.axis.radius.push_back(radius);
  }
  geometry::complete(tube.axis);
  shape.tubes.push_back(tube);
  return {geometry::structured_surface(tube, around, 0.17 * radius), tree_of(shape)};
}

}  // namespace ostia::meshing
