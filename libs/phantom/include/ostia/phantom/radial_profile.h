#pragma once
/// \file A star-shaped boundary about an axis: r(s, theta).

#include <vector>

namespace ostia::phantom {

/// Radii on a regular grid, `around` angles a row from theta = 0 (geometry::radial_direction), rows `step_mm`
/// apart from s = 0. Between them the boundary is a bicubic (Catmull-Rom) surface, periodic in theta and C1;
/// beyond the ends the end row's. This interpolant is the truth: everything else is measured against it.
class RadialProfile {
 public:
  RadialProfile() = default;
  /// Throws InvalidInput where rows are incomplete, fewer than 4, or a radius is not positive and finite.
  RadialProfile(double step_mm, int around, std::vector<double> radii);
  double at(double s_mm, double theta) const;  ///< mm
  double mean_at(double s_mm) const;           ///< over theta
  double min_at(double s_mm) const;
  double max_at(double s_mm) const;
  double area_at(double s_mm) const;           ///< mm^2 of the cross-section
  double largest() const { return largest_; }  ///< bound over the whole interpolant
  double smallest() const { return smallest_; }
  double length_mm() const;
  int around() const { return around_; }
  double step_mm() const { return step_mm_; }

 private:
  double step_mm_ = 0.0;
  int around_ = 0, rows_ = 0;
  std::vector<double> radii_;
  double largest_ = 0.0, smallest_ = 0.0;
};

}  // namespace ostia::phantom
