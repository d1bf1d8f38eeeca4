#pragma once
/// \file Circles and ellipses of least squares in a plane.

#include "ostia/geometry/vec.h"

#include <optional>
#include <vector>

namespace ostia::centerline::detail {

struct Circle {
  geometry::Vec2 centre = geometry::Vec2::Zero();
  double radius = 0.0;
};

struct Ellipse {
  geometry::Vec2 centre = geometry::Vec2::Zero();
  double semi_major = 0.0, semi_minor = 0.0;
  geometry::Vec2 major = geometry::Vec2::UnitX();  // unit
};

// Least squares of x^2 + y^2 = a x + b y + c (I. Kasa, IEEE Trans. Instrum. Meas. 25:8-14, 1976); nothing for
// fewer than three points or points on a line.
std::optional<Circle> fit_circle(const std::vector<geometry::Vec2>& points);

// Direct least squares (A. Fitzgibbon, M. Pilu, R. B. Fisher, IEEE Trans. Pattern Anal. Mach. Intell.
// 21:476-480, 1999) in the numerically stable form of R. Halir and J. Flusser (WSCG 1998); nothing for fewer
// than six points or where no ellipse fits.
std::optional<Ellipse> fit_ellipse(const std::vector<geometry::Vec2>& points);

// Distance of a point from an ellipse along the ray from its centre, as a part of the ellipse's reach there.
double relative_miss(const Ellipse& ellipse, const geometry::Vec2& point);

}  // namespace ostia::centerline::detail
