#pragma once
/// \file Surfaces and measures that several tests of this room share.

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/geometry/analytic_shapes.h"

namespace ostia::testing {

/// A straight tube along z whose ends are half spheres: axis from z = 0 to `length`.
geometry::TriMesh capsule(double length, double radius, double spacing);

/// Whether the bits of all points and radii are the same.
bool identical(const centerline::CenterlineResult& a, const centerline::CenterlineResult& b);

/// How far a line is from the true axes of a shape, away from its ends and from where its tubes lie in each
/// other.
struct AxisError {
  std::size_t points = 0;
  double mean_mm = 0.0, max_mm = 0.0;
  double mean_radius = 0.0, max_radius = 0.0;  ///< relative
  double mean_turn_deg = 0.0;                  ///< between steps
};
/// Left out: points within `margin` local radii of a tube's end, and of the stretch from where a tube begins
/// on another to where the two are clear of each other.
AxisError axis_error(const std::vector<geometry::Centerline>& lines, const geometry::AnalyticShape& shape,
                     double margin = 2.5);

}  // namespace ostia::testing
