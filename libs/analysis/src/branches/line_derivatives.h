#pragma once
/// \file Derivatives of what is known at points along a line.

#include "ostia/geometry/vec.h"

#include <array>
#include <vector>

namespace ostia::analysis {

/// First to third derivatives by the abscissa of polynomials of degree 5, fitted by least squares about each
/// point to its neighbours within `reach_mm` on both sides, weighted by 1 - (distance / reach)^2 (Savitzky
/// and Golay; Cleveland). At the ends the piece stays as long as in the middle. The same weights serve any
/// values at the points.
class LineDerivatives {
 public:
  /// `s_mm` rises; six points at least (what a polynomial has coefficients). A reach with too few points
  /// becomes longer.
  LineDerivatives(const std::vector<double>& s_mm, double reach_mm);
  /// [order - 1][point]
  std::array<std::vector<geometry::Vec3>, 3> operator()(const std::vector<geometry::Vec3>& values) const;

 private:
  struct Row {
    std::size_t first = 0;
    std::array<std::vector<double>, 3> weights;
  };
  std::vector<Row> rows_;
};

}  // namespace ostia::analysis
