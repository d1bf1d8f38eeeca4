#pragma once
/// \file Minimum of a smooth function of many unknowns, without bounds.

#include "ostia/core/task_context.h"

#include <Eigen/Core>

#include <functional>

namespace ostia::experiments {

/// Value at a place; the gradient goes into the second argument.
using SmoothFunction = std::function<double(const Eigen::VectorXd&, Eigen::VectorXd&)>;

struct Minimum {
  Eigen::VectorXd place;
  double value = 0.0;
  int iterations = 0, evaluations = 0;
  bool converged = false;
};

/// Limited-memory BFGS (Nocedal 1980; what L-BFGS-B of Byrd, Lu, Nocedal and Zhu 1995 is without bounds), the
/// last eight steps kept, steps by the weak Wolfe conditions. Converged when an iteration lowers the value by
/// less than `tolerance` of it, or of 1 if that is more, the gradient is zero, or no step against it lowers
/// the value. Throws Cancelled.
Minimum minimise(const SmoothFunction& function, Eigen::VectorXd start, int most_iterations, double tolerance,
                 const core::TaskContext& task);

}  // namespace ostia::experiments
