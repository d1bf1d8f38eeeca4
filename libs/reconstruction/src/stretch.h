#pragma once
/// \file How a circle is stretched to an ellipse of the same area, in a frame across the vessel.

#include "ostia/geometry/frame.h"
#include "ostia/reconstruction/elliptic_sections.h"

namespace ostia::reconstruction {

/// The logarithm of the symmetric matrix that makes the ellipse of the unit circle is [[c, s], [s, -c]]:
/// |(c, s)| is ln(major / minor) / 2, and twice the major axis' angle from the frame's normal to its binormal
/// is the angle of (c, s). Means of these are the means of such matrices; circles are 0.
struct Stretch {
  double c = 0.0, s = 0.0;

  bool round() const { return c == 0.0 && s == 0.0; }
  Stretch operator*(double factor) const { return {factor * c, factor * s}; }
  Stretch operator+(const Stretch& other) const { return {c + other.c, s + other.s}; }
};

Stretch stretch_of(const EllipticSection& section, const geometry::Frame& frame);
EllipticSection section_of(const Stretch& stretch, const geometry::Frame& frame);
/// Where a point of the circle goes (normal and binormal coordinates), and where one of the ellipse comes
/// from.
geometry::Vec2 stretched(const Stretch& stretch, const geometry::Vec2& point);
geometry::Vec2 unstretched(const Stretch& stretch, const geometry::Vec2& point);

}  // namespace ostia::reconstruction
