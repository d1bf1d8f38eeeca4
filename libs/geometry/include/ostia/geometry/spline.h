#pragma once
/// \file Cubic splines in arc length through points, and smoothing splines.

#include "ostia/geometry/vec.h"

#include <vector>

namespace ostia::geometry {

/// A C2 cubic spline through points in n dimensions of space (3) plus one scalar (the radius), parametrised
/// by the points' chord length, natural ends, and re-parametrised by arc length to 1e-6 relative.
class ArcLengthSpline {
 public:
  /// At least two distinct points (repeated neighbours count once); `scalar` empty or one a point. Throws
  /// InvalidInput.
  explicit ArcLengthSpline(const std::vector<Vec3>& points, const std::vector<double>& scalar = {});
  double length() const;                            ///< mm
  Vec3 point(double abscissa_mm) const;             ///< clamped to the ends
  Vec3 tangent(double abscissa_mm) const;           ///< unit
  Vec3 curvature_vector(double abscissa_mm) const;  ///< 1/mm, towards the centre of curvature
  double scalar(double abscissa_mm) const;

 private:
  std::vector<double> knots_;                     // chord-length parameter of each point
  std::vector<double> arc_;                       // arc length at each knot
  std::vector<Eigen::Vector4d> values_, second_;  // point and scalar, and their second derivatives
  double parameter(double abscissa_mm) const;
};

/// Weighted smoothing spline (Reinsch 1967): minimises sum w_i |p_i - s(t_i)|^2 + lambda * integral |s''|^2
/// over natural cubic splines at the parameters t (strictly increasing); O(n). Returns the fitted values at
/// t. Both ends are kept exactly when `fix_ends`. Weights are positive, lambda is 0 (interpolates) or more,
/// in mm^3 where t is in mm and weights have no unit. Throws InvalidInput.
std::vector<Vec3> smoothing_spline(const std::vector<double>& t, const std::vector<Vec3>& points,
                                   const std::vector<double>& weights, double lambda, bool fix_ends);
std::vector<double> smoothing_spline(const std::vector<double>& t, const std::vector<double>& values,
                                     const std::vector<double>& weights, double lambda, bool fix_ends);

}  // namespace ostia::geometry
