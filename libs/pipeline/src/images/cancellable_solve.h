#pragma once
/// \file Large sparse systems that can be left while they are solved.

#include "ostia/core/task_context.h"

#include <Eigen/Core>
#include <Eigen/SparseCore>

namespace ostia::pipeline {

/// Conjugate gradients with the diagonal as preconditioner (Saad, Iterative Methods for Sparse Linear
/// Systems, 2003, algorithm 9.1) for a symmetric positive definite matrix, from zero, until the residual is
/// below `tolerance` of the right side's norm or as many rounds as there are unknowns are done. Zero for a
/// right side of zero. Throws Cancelled.
Eigen::VectorXd solved(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                       const Eigen::VectorXd& right, double tolerance, const core::TaskContext& task);

}  // namespace ostia::pipeline
