#pragma once
/// \file The system that the constraints of a wall make, and what both ways of solving it share.

#include "interpolation/constraints.h"
#include "interpolation/sparse_factor.h"

#include <functional>
#include <vector>

namespace ostia::lumen {

/// phi of all pairs of constraints, in their order. Throws ResourceError before the triangle outgrows
/// `limits`, and InvalidInput for places so near to each other that their rows are alike.
SymmetricMatrix interpolation_matrix(const std::vector<Constraint>& constraints,
                                     const InterpolationOptions& options, const FactorLimits& limits = {});

/// Weights and polynomial.
struct Solution {
  Eigen::VectorXd weights;
  std::array<double, 4> polynomial{0.0, 0.0, 0.0, 0.0};
  double residual = 0.0;  ///< largest |f(p_i) - h_i|, mm
};
using MatrixAction = std::function<Eigen::MatrixXd(const Eigen::MatrixXd&)>;
/// Solves [Wels] eq. 3 with A^-1 (`inverse`) and A (`forward`): the constant far field by one right-hand
/// side, the linear one by the Schur complement P^T A^-1 P; refined until the residual no longer falls.
/// Throws NumericalError where it stays above 1e-7 mm.
Solution solve_system(const std::vector<Constraint>& constraints, const InterpolationOptions& options,
                      const MatrixAction& inverse, const MatrixAction& forward);

ImplicitSurface surface_of(const std::vector<Constraint>& constraints, const InterpolationOptions& options,
                           const Solution& solution);

}  // namespace ostia::lumen
