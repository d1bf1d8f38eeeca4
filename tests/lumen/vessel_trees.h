#pragma once
/// \file Vessel trees from analytic shapes, for tests of the lumen.

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/vessel_tree.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

namespace ostia::lumen::testing {

using geometry::Centerline;
using geometry::Vec3;
using geometry::VesselTree;

inline Centerline part(const Centerline& line, std::size_t first, std::size_t last) {
  Centerline result;
  result.points.assign(line.points.begin() + static_cast<std::ptrdiff_t>(first),
                       line.points.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  result.radius.assign(line.radius.begin() + static_cast<std::ptrdiff_t>(first),
                       line.radius.begin() + static_cast<std::ptrdiff_t>(last) + 1);
  geometry::complete(result, line.frames.empty() ? Vec3(Vec3::Zero()) : line.frames[first].normal);
  return result;
}

/// Nodes 1 and 2, segment 3, vessel 4.
inline VesselTree tree_of(Centerline axis, const std::string& name = "LAD") {
  if (axis.abscissa.size() != axis.size()) geometry::complete(axis);
  VesselTree tree;
  tree.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  tree.segments = {{3, 1, 2, std::move(axis)}};
  tree.vessels = {{4, name, {3}}};
  return tree;
}

inline VesselTree tree_of(const geometry::AnalyticTube& tube) {
  return tree_of(tube.axis);
}

/// Along +z from the origin.
inline VesselTree straight_vessel(double length_mm, double radius_mm, double step_mm = 0.5) {
  return tree_of(geometry::straight_tube(length_mm, radius_mm, step_mm).tubes.front());
}

/// The first tube is the trunk; the others begin on its axis points (or its end). The trunk's vessel, or for
/// a trunk that ends where tubes begin the first of them with the trunk, comes first.
inline VesselTree tree_of(const geometry::AnalyticShape& shape) {
  const Centerline& trunk = shape.tubes.front().axis;
  std::vector<std::pair<std::size_t, std::size_t>> starts;  // trunk point, tube
  for (std::size_t i = 1; i < shape.tubes.size(); ++i) {
    const Vec3 start = shape.tubes[i].axis.points.front();
    const auto nearest = std::min_element(
        trunk.points.begin(), trunk.points.end(),
        [&](const Vec3& a, const Vec3& b) { return (a - start).squaredNorm() < (b - start).squaredNorm(); });
    starts.emplace_back(static_cast<std::size_t>(nearest - trunk.points.begin()), i);
  }
  std::stable_sort(starts.begin(), starts.end());
  VesselTree tree;
  std::int32_t next = 1;
  const auto add_node = [&](const Vec3& at) {
    tree.nodes.push_back({next, at});
    return next++;
  };
  const auto add_segment = [&](std::int32_t from, Centerline axis) {
    const std::int32_t to = add_node(axis.points.back());
    if (axis.frames.empty()) geometry::complete(axis);
    tree.segments.push_back({next, from, to, std::move(axis)});
    return next++;
  };
  std::vector<std::int32_t> way;  // the trunk's segments so far
  std::int32_t here = add_node(trunk.points.front());
  std::size_t from = 0;
  std::vector<std::pair<std::string, std::vector<std::int32_t>>> branches;
  for (const auto& [at, tube] : starts) {
    if (at > from) {
      way.push_back(add_segment(here, part(trunk, from, at)));
      here = tree.segments.back().to;
      from = at;
    }
    Centerline axis = shape.tubes[tube].axis;
    axis.points.front() = trunk.points[at];
    auto path = way;
    path.push_back(add_segment(here, axis));
    branches.emplace_back(shape.tubes[tube].name, std::move(path));
  }
  if (from + 1 < trunk.size()) {
    way.push_back(add_segment(here, part(trunk, from, trunk.size() - 1)));
    branches.insert(branches.begin(), {shape.tubes.front().name, way});
  }
  for (auto& [name, path] : branches) tree.vessels.push_back({next++, name, std::move(path)});
  return tree;
}

/// A straight main vessel along z that a side branch leaves at 45 degrees, in the xz plane.
struct YTree {
  double joint_mm = 20.0, main_length_mm = 50.0, side_length_mm = 30.0;
  double main_radius_mm = 2.0, side_radius_mm = 1.2;
  std::int32_t main_id = 7, side_id = 8;
  std::string main_name = "LAD", side_name = "D1";

  VesselTree tree() const {
    const Vec3 joint(0, 0, joint_mm), end(0, 0, main_length_mm);
    const Vec3 tip = joint + side_length_mm * Vec3(1, 0, 1).normalized();
    const auto line = [](const Vec3& from, const Vec3& to, double radius) {
      Centerline axis;
      const int pieces = static_cast<int>(std::lround((to - from).norm() / 0.5));
      for (int i = 0; i <= pieces; ++i) {
        axis.points.push_back(from + (to - from) * i / pieces);
        axis.radius.push_back(radius);
      }
      geometry::complete(axis);
      return axis;
    };
    VesselTree made;
    made.nodes = {{1, Vec3::Zero()}, {2, joint}, {3, end}, {4, tip}};
    made.segments = {{10, 1, 2, line(Vec3::Zero(), joint, main_radius_mm)},
                     {11, 2, 3, line(joint, end, main_radius_mm)},
                     {12, 2, 4, line(joint, tip, side_radius_mm)}};
    made.vessels = {{main_id, main_name, {10, 11}}, {side_id, side_name, {10, 12}}};
    return made;
  }
};

}  // namespace ostia::lumen::testing
