#pragma once
/// \file Trees and motions whose measures are known from formulas.

#include "ostia/analysis/motion_measures.h"

#include <cmath>
#include <functional>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::analysis::testing {

inline constexpr double whole_turn = 2.0 * std::numbers::pi;

/// Where a point of the template is at a phase.
using Motion = std::function<Vec3(const Vec3&, double phase)>;

inline geometry::Centerline line_of(const std::vector<Vec3>& points, double radius = 1.0) {
  geometry::Centerline line;
  line.points = points;
  line.radius.assign(points.size(), radius);
  geometry::complete(line);
  return line;
}

inline std::vector<Vec3> straight(const Vec3& from, const Vec3& to, double step_mm = 0.5) {
  const int pieces = static_cast<int>(std::lround((to - from).norm() / step_mm));
  std::vector<Vec3> points;
  for (int i = 0; i <= pieces; ++i) points.push_back(from + (to - from) * (static_cast<double>(i) / pieces));
  return points;
}

/// Vessels that do not touch.
inline geometry::VesselTree apart(const std::vector<std::vector<Vec3>>& lines) {
  geometry::VesselTree tree;
  std::int32_t id = 1;
  for (const auto& points : lines) {
    const std::int32_t from = id++, to = id++, segment = id++, vessel = id++;
    tree.nodes.push_back({from, points.front()});
    tree.nodes.push_back({to, points.back()});
    tree.segments.push_back({segment, from, to, line_of(points)});
    tree.vessels.push_back({vessel, "V" + std::to_string(tree.vessels.size() + 1), {segment}});
  }
  return tree;
}

/// A trunk from -30 on z to the origin, where it goes on as "main" and leaves "side", both straight, at equal
/// angles with z.
inline geometry::VesselTree fork(double angle, double arm_mm = 20.0) {
  const Vec3 a(std::sin(angle / 2), 0, std::cos(angle / 2)), b(-std::sin(angle / 2), 0, std::cos(angle / 2));
  geometry::VesselTree tree;
  tree.nodes = {{1, {0, 0, -30}}, {2, {0, 0, 0}}, {3, arm_mm * a}, {4, arm_mm * b}};
  tree.segments = {{11, 1, 2, line_of(straight({0, 0, -30}, {0, 0, 0}))},
                   {12, 2, 3, line_of(straight({0, 0, 0}, arm_mm * a))},
                   {13, 2, 4, line_of(straight({0, 0, 0}, arm_mm * b))}};
  tree.vessels = {{21, "main", {11, 12}}, {22, "side", {11, 13}}};
  return tree;
}

inline geometry::VesselTree moved(geometry::VesselTree tree, const Motion& motion, double phase) {
  for (auto& node : tree.nodes) node.position = motion(node.position, phase);
  for (auto& segment : tree.segments)
    for (Vec3& p : segment.axis.points) p = motion(p, phase);
  return tree;
}

/// Its points followed exactly.
inline MovingTree followed(const geometry::VesselTree& rest, const Motion& motion, int phases = 20) {
  std::vector<geometry::VesselTree> trees;
  for (const double phase : even_phases(phases)) trees.push_back(moved(rest, motion, phase));
  return followed_tree(rest, 0.0, even_phases(phases), trees);
}

/// A cage whose control points go as the motion does, around the tree and a box, as that of a whole heart.
inline geometry::CageMotion cage_of(const geometry::VesselTree& rest, const Motion& motion,
                                    const geometry::Box3& heart, int depth = 4, int phases = 20) {
  std::vector<Vec3> points{heart.min(), heart.max()};
  for (const auto& segment : rest.segments)
    points.insert(points.end(), segment.axis.points.begin(), segment.axis.points.end());
  geometry::CageMotion cage;
  cage.grid = geometry::cage_around(points, depth);
  cage.template_phase = 0.0;
  for (const double phase : even_phases(phases)) {
    geometry::CagePhase one{phase, {}, geometry::PhaseOrigin::fitted};
    for (const Vec3& p : geometry::rest_points(cage.grid)) one.control_points.push_back(motion(p, phase));
    cage.phases.push_back(std::move(one));
  }
  return cage;
}

/// A helix about z: x = a cos(k z), y = a sin(k z).
struct Helix {
  double a = 20.0, k = whole_turn / 120.0;
  double rise() const { return std::sqrt(1.0 + a * a * k * k); }  ///< arc length a mm along z
  double curvature() const { return a * k * k / (1.0 + a * a * k * k); }
  double torsion() const { return k / (1.0 + a * a * k * k); }
  std::vector<Vec3> points(double length_mm, double step_mm = 0.5) const {
    const int pieces = static_cast<int>(std::lround(length_mm / step_mm));
    std::vector<Vec3> line;
    for (int i = 0; i <= pieces; ++i) {
      const double z = length_mm * i / pieces / rise();
      line.emplace_back(a * std::cos(k * z), a * std::sin(k * z), z);
    }
    return line;
  }
};

/// Thinning, shortening and turning about z that grows along it: a helix about z becomes another one.
struct HeartBeat {
  double thinning = 0.1, shortening = 0.12, twist_per_mm = 15.0 / 60.0 * std::numbers::pi / 180.0;
  static double share(double phase) { return 0.5 - 0.5 * std::cos(whole_turn * phase); }
  Vec3 operator()(const Vec3& p, double phase) const {
    const double c = share(phase), angle = c * twist_per_mm * p.z(), r = 1.0 - c * thinning;
    return {r * (p.x() * std::cos(angle) - p.y() * std::sin(angle)),
            r * (p.x() * std::sin(angle) + p.y() * std::cos(angle)), p.z() * (1.0 - c * shortening)};
  }
  Helix operator()(const Helix& helix, double phase) const {
    const double c = share(phase);
    return {helix.a * (1.0 - c * thinning), (helix.k + c * twist_per_mm) / (1.0 - c * shortening)};
  }
  double stretch(const Helix& helix, double phase) const {
    return (*this)(helix, phase).rise() * (1.0 - share(phase) * shortening) / helix.rise();
  }
};

inline const geometry::Box3 heart_box{Vec3(-45, -45, -5), Vec3(45, 45, 95)};

}  // namespace ostia::analysis::testing
