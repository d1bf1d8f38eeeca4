#pragma once
/// \file The smooth curve through the points of an edit, and how it is sampled.

#include "ostia/geometry/spline.h"

#include <optional>
#include <utility>
#include <vector>

namespace ostia::lumen {

using geometry::Vec2;
using geometry::Vec3;

/// A place on a drawn curve.
struct CurvePlace {
  Vec3 point = Vec3::Zero();
  Vec3 tangent = Vec3::UnitX();  ///< unit
};

/// A C2 curve in arc length through points; closed ones are smooth where they close.
class DrawnCurve {
 public:
  /// At least two distinct points, three for a closed curve; the first is not repeated at the end.
  DrawnCurve(const std::vector<Vec3>& points, bool closed);
  double length() const { return knots_.back() - knots_.front(); }
  bool closed() const { return closed_; }
  CurvePlace at(double abscissa_mm) const;  ///< from the first point
  /// The points themselves, and between them as many as are needed for steps of about `spacing_mm`.
  std::vector<CurvePlace> sampled(double spacing_mm) const;

 private:
  bool closed_;
  std::vector<double> knots_;  // on the spline, of the points; of a closed curve with the first again
  geometry::ArcLengthSpline spline_;
};

/// Neighbours nearer than `least_mm` become one, their mean; the ends of an open line stay where they are
/// unless they are that near to each other.
std::vector<Vec3> merged_neighbours(const std::vector<Vec3>& points, double least_mm, bool closed);

/// The first two pieces of a line in the plane that cross, by the index of their first points.
std::optional<std::pair<std::size_t, std::size_t>> self_crossing(const std::vector<Vec2>& line, bool closed);

}  // namespace ostia::lumen
