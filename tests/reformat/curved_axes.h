#pragma once
/// \file Axes that curved views are tried on.

#include "ostia/geometry/analytic_shapes.h"
#include "ostia/reformat/curved_reformation.h"

#include <cmath>
#include <numbers>

namespace ostia::reformat::testing {

inline constexpr double pi = std::numbers::pi;
using Axis = std::shared_ptr<const geometry::AxisCurve>;

inline Axis curve(const geometry::Centerline& line) {
  return std::make_shared<const geometry::AxisCurve>(line);
}

inline Axis helix() {
  return curve(geometry::helix_tube(10.0, 12.0, 2.0, 1.0, 0.1).tubes[0].axis);
}

inline Axis straight(double length = 30.0) {
  return curve(geometry::straight_tube(length, 1.5).tubes[0].axis);
}

/// Two legs along y joined by half a circle of radius R in the plane z = 0.
inline Axis hairpin(double radius, double leg = 12.0) {
  geometry::Centerline line;
  for (double y = -leg; y < -1e-9; y += 0.1) line.points.emplace_back(radius, y, 0.0);
  const int pieces = static_cast<int>(pi * radius / 0.1);
  for (int i = 0; i <= pieces; ++i) {
    const double a = pi * i / pieces;
    line.points.emplace_back(radius * std::cos(a), radius * std::sin(a), 0.0);
  }
  for (double y = -0.1; y > -leg; y -= 0.1) line.points.emplace_back(-radius, y, 0.0);
  return curve(line);
}

/// A stretch of a course like a coronary artery's, with bends of about 6 mm.
inline Axis coronary() {
  geometry::Centerline line;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0, a = 0.2 + 1.6 * t;
    line.points.emplace_back(40.0 * std::cos(a) + 2.0 * std::sin(14.0 * t), 40.0 * std::sin(a),
                             20.0 - 40.0 * t + 2.5 * std::cos(11.0 * t));
  }
  return curve(line);
}

inline CurvedOptions options(CurvedMode mode, double theta_deg, double pixel_mm = 0.25) {
  CurvedOptions o;
  o.mode = mode;
  o.theta_deg = theta_deg;
  o.pixel_mm = pixel_mm;
  o.width = 101;
  o.height = 240;
  o.s_start_mm = -3.0;
  return o;
}

inline constexpr CurvedMode both[] = {CurvedMode::straightened, CurvedMode::stretched};

}  // namespace ostia::reformat::testing
