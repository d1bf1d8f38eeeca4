#include "images/cancellable_solve.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <vector>

namespace ostia::pipeline {
namespace {

using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;

/// Springs between neighbours in a row, both ends fixed: its smallest eigenvalue is about (pi / n)^2.
Matrix chain(Eigen::Index n) {
  std::vector<Eigen::Triplet<double>> entries;
  for (Eigen::Index i = 0; i < n; ++i) {
    entries.emplace_back(i, i, 2.0);
    if (i > 0) entries.emplace_back(i, i - 1, -1.0);
    if (i + 1 < n) entries.emplace_back(i, i + 1, -1.0);
  }
  Matrix matrix(n, n);
  matrix.setFromTriplets(entries.begin(), entries.end());
  return matrix;
}

TEST(CancellableSolve, FindsWhatWasPutIn) {
  const Eigen::Index n = 400;
  const Matrix matrix = chain(n);
  const Eigen::VectorXd truth = Eigen::VectorXd::LinSpaced(n, -1.0, 3.0).array().sin();
  const Eigen::VectorXd found = solved(matrix, matrix * truth, 1e-12, core::no_task());
  EXPECT_LT((found - truth).norm(), 1e-6 * truth.norm());
}

TEST(CancellableSolve, OfZeroIsZero) {
  EXPECT_EQ(solved(chain(10), Eigen::VectorXd::Zero(10), 1e-9, core::no_task()), Eigen::VectorXd::Zero(10));
}

TEST(CancellableSolve, CanBeLeft) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(solved(chain(100), Eigen::VectorXd::Ones(100), 1e-12, task), Cancelled);
}

}  // namespace
}  // namespace ostia::pipeline
