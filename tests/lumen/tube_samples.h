#pragma once
/// \file Samples on analytic walls, for tests.

#include "ostia/lumen/vessel_lumen.h"

#include <cmath>
#include <functional>
#include <numbers>

namespace ostia::lumen::testing {

/// A wall about an axis by its radius at (s, theta).
using Radius = std::function<double(double, double)>;

inline std::shared_ptr<const geometry::AxisCurve> straight_axis(double length_mm) {
  geometry::Centerline line;
  for (int i = 0; i <= 4 * static_cast<int>(length_mm); ++i) line.points.push_back({0.0, 0.0, 0.25 * i});
  return std::make_shared<const geometry::AxisCurve>(line);
}

/// A gently bent axis: a helix of radius 25 mm.
inline std::shared_ptr<const geometry::AxisCurve> bent_axis(double length_mm) {
  geometry::Centerline line;
  for (double s = 0.0; s <= length_mm + 1e-9; s += 0.25) {
    const double a = s / std::hypot(25.0, 8.0);
    line.points.push_back({25.0 * std::cos(a), 25.0 * std::sin(a), 8.0 * a});
  }
  return std::make_shared<const geometry::AxisCurve>(line);
}

/// The outward normal of r(s, theta) about an axis, by differences.
inline Vec3 wall_normal(const geometry::AxisCurve& axis, const Radius& radius, double s, double theta) {
  constexpr double h = 1e-4;
  const auto at = [&](double a, double b) { return axis.place(a, b, radius(a, b)); };
  const Vec3 along = at(s + h, theta) - at(s - h, theta), around = at(s, theta + h) - at(s, theta - h);
  const Vec3 normal = around.cross(along).normalized();
  return normal.dot(at(s, theta) - axis.point(s)) > 0.0 ? normal : Vec3(-normal);
}

/// Staggered rings `spacing_mm` apart with rounded caps at both ends.
inline VesselLumen tube_vessel(std::shared_ptr<const geometry::AxisCurve> axis, const Radius& radius,
                               double spacing_mm = 1.0) {
  constexpr double pi = std::numbers::pi;
  VesselLumen vessel;
  vessel.vessel = 4;
  vessel.axis = axis;
  std::int64_t id = 1;
  const double length = axis->length();
  const int rings = static_cast<int>(std::ceil(length / spacing_mm));
  const auto cap = [&](double s, double side) {
    const geometry::Frame frame = axis->frame(s);
    const double r = radius(s, 0.0);
    const int steps = std::max(1, static_cast<int>(std::round(0.5 * pi * r / spacing_mm)));
    for (int k = 1; k <= steps; ++k) {
      const double tilt = 0.5 * pi * k / steps;
      const int around =
          k == steps ? 1 : std::max(4, static_cast<int>(2.0 * pi * r * std::cos(tilt) / spacing_mm));
      for (int i = 0; i < around; ++i) {
        const Vec3 radial = geometry::radial_direction(frame, 2.0 * pi * (i + 0.5 * (k % 2)) / around);
        const Vec3 normal = std::cos(tilt) * radial + side * std::sin(tilt) * frame.tangent;
        vessel.samples.push_back({id++, axis->point(s) + r * normal, normal, s, SampleOrigin::cap});
      }
    }
  };
  cap(0.0, -1.0);
  for (int k = 0; k <= rings; ++k) {
    const double s = length * k / rings;
    const int around = std::max(8, static_cast<int>(std::ceil(2.0 * pi * radius(s, 0.0) / spacing_mm)));
    for (int i = 0; i < around; ++i) {
      const double theta = 2.0 * pi * (i + 0.5 * (k % 2)) / around;
      vessel.samples.push_back({id++, axis->place(s, theta, radius(s, theta)),
                                wall_normal(*axis, radius, s, theta), s, SampleOrigin::start});
    }
  }
  cap(length, 1.0);
  std::sort(vessel.samples.begin(), vessel.samples.end(), canonical_order);
  vessel.interpolation.support_radius_mm = default_support_radius(vessel.samples);
  return vessel;
}

}  // namespace ostia::lumen::testing
