#pragma once
/// \file Trees and walls whose bifurcations and sections are known.

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/branch_groups.h"

#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

namespace ostia::analysis {

inline constexpr double degree = std::numbers::pi / 180.0;

inline geometry::Centerline straight_axis(const geometry::Vec3& from, const geometry::Vec3& to,
                                          double radius) {
  geometry::Centerline line;
  const auto pieces = static_cast<int>(std::ceil((to - from).norm() / 0.2));
  for (int i = 0; i <= pieces; ++i) {
    line.points.push_back(from + (to - from) * i / pieces);
    line.radius.push_back(radius);
  }
  geometry::complete(line);
  return line;
}

/// A parent of 20 mm that ends at the origin, `tilt` out of the xz plane; two children in that plane, half
/// the angle to either side of +z.
inline geometry::VesselTree straight_y(double between_deg, double tilt_deg, double radius) {
  const double half = 0.5 * between_deg * degree, tilt = tilt_deg * degree;
  const std::vector<geometry::Vec3> p{{0, -20 * std::sin(tilt), -20 * std::cos(tilt)},
                                      {0, 0, 0},
                                      {20 * std::sin(half), 0, 20 * std::cos(half)},
                                      {-20 * std::sin(half), 0, 20 * std::cos(half)}};
  geometry::VesselTree tree;
  for (std::size_t i = 0; i < p.size(); ++i) tree.nodes.push_back({static_cast<std::int32_t>(i), p[i]});
  tree.segments = {{0, 0, 1, straight_axis(p[0], p[1], radius)},
                   {1, 1, 2, straight_axis(p[1], p[2], radius)},
                   {2, 1, 3, straight_axis(p[1], p[3], radius)}};
  tree.vessels = {{0, "a", {0, 1}}, {1, "b", {0, 2}}};
  return tree;
}

inline geometry::VesselTree tree_of_tubes(const geometry::AnalyticShape& y) {
  geometry::VesselTree tree;
  const auto add = [&](const geometry::AnalyticTube& tube, std::int32_t from) {
    const auto node = static_cast<std::int32_t>(tree.nodes.size());
    const auto id = static_cast<std::int32_t>(tree.segments.size());
    tree.nodes.push_back({node, tube.axis.points.back()});
    tree.segments.push_back({id, from, node, tube.axis});
  };
  tree.nodes.push_back({0, y.tubes[0].axis.points.front()});
  add(y.tubes[0], 0);
  for (std::size_t i = 1; i < y.tubes.size(); ++i) {
    add(y.tubes[i], 1);
    tree.vessels.push_back({static_cast<std::int32_t>(i), "child", {0, static_cast<std::int32_t>(i)}});
  }
  return tree;
}

/// A tube about each segment.
inline geometry::AnalyticShape shape_of(const geometry::VesselTree& tree) {
  geometry::AnalyticShape shape;
  for (const geometry::TreeSegment& segment : tree.segments) {
    shape.tubes.push_back({"tube", segment.axis});
    for (std::size_t i = 0; i < segment.axis.size(); ++i) {
      const geometry::Vec3 reach = geometry::Vec3::Constant(segment.axis.radius[i] + 2.0);
      shape.box.extend(geometry::Vec3(segment.axis.points[i] - reach));
      shape.box.extend(geometry::Vec3(segment.axis.points[i] + reach));
    }
  }
  return shape;
}

/// One vessel of one segment.
inline geometry::BranchedLines one_line(const geometry::Centerline& axis) {
  geometry::VesselTree tree;
  tree.nodes = {{0, axis.points.front()}, {1, axis.points.back()}};
  tree.segments = {{0, 0, 1, axis}};
  tree.vessels = {{0, "tube", {0}}};
  return geometry::branch_groups(tree);
}

}  // namespace ostia::analysis
