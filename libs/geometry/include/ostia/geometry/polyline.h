#pragma once
/// \file Open curves through points.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// A curve of straight pieces through at least two points, in mm.
struct Polyline {
  std::vector<Vec3> points;
};

/// Length along the line at each point, from 0. Empty for an empty line.
std::vector<double> abscissas(const std::vector<Vec3>& points);
double length(const std::vector<Vec3>& points);

/// A place on a polyline: between points `segment` and `segment + 1`, at `t` in [0, 1].
struct PolylineLocation {
  std::size_t segment = 0;
  double t = 0.0;
  double abscissa = 0.0;  ///< mm from the first point
  Vec3 point = Vec3::Zero();
};

/// The point at an abscissa, clamped to the ends. Throws InvalidInput for fewer than two points.
PolylineLocation at_abscissa(const std::vector<Vec3>& points, double abscissa_mm);
/// The nearest point of the line (the first of equals).
PolylineLocation closest(const std::vector<Vec3>& points, const Vec3& query);
/// Points at equal steps no longer than `step_mm`, both ends kept.
std::vector<Vec3> resample(const std::vector<Vec3>& points, double step_mm);

}  // namespace ostia::geometry
