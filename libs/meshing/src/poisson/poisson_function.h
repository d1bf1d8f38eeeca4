#pragma once
/// \file The indicator function of Poisson's equation.

#include "ostia/geometry/vec.h"

#include <memory>
#include <vector>

namespace ostia::meshing {

/// Negative inside; at the points 0 in the mean of a neighbourhood. One thread at a time.
class PoissonFunction {
 public:
  /// Throws NumericalError.
  PoissonFunction(const std::vector<geometry::Vec3>& points, const std::vector<geometry::Vec3>& normals);
  ~PoissonFunction();
  double operator()(const geometry::Vec3& point) const;
  double mean_spacing_mm() const;  ///< of the points, to their six nearest

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::meshing
