#include "interpolation/sparse_factor.h"

#include "ostia/core/error.h"

#include <Eigen/Cholesky>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::lumen {
namespace {

// A band matrix, dominant on its diagonal.
Eigen::MatrixXd dense_band(int size, int band) {
  Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(size, size);
  for (int j = 0; j < size; ++j)
    for (int i = j; i < std::min(size, j + band); ++i)
      matrix(i, j) = matrix(j, i) = i == j ? band : std::cos(3.0 * i + 7.0 * j);
  return matrix;
}

SymmetricMatrix sparse(const Eigen::MatrixXd& dense) {
  SymmetricMatrix matrix;
  matrix.size = static_cast<int>(dense.rows());
  matrix.column_start.push_back(0);
  for (int j = 0; j < matrix.size; ++j) {
    for (int i = j; i < matrix.size; ++i) {
      if (i != j && dense(i, j) == 0.0) continue;
      matrix.row.push_back(i);
      matrix.value.push_back(dense(i, j));
    }
    matrix.column_start.push_back(static_cast<int>(matrix.row.size()));
  }
  return matrix;
}

TEST(SparseFactor, SolvesSeveralRightSidesAsTheDenseFactorDoes) {
  const Eigen::MatrixXd dense = dense_band(120, 9);
  const SparseFactor factor(sparse(dense));
  Eigen::MatrixXd right(120, 5);
  for (int i = 0; i < right.size(); ++i) right.data()[i] = std::sin(1.0 + i);
  const Eigen::MatrixXd expected = dense.llt().solve(right);
  EXPECT_LT((factor.solve(right) - expected).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GE(factor.nonzeros(), 120.0 * 8.0);
}

TEST(SparseFactor, ProductIsThatOfTheWholeMatrix) {
  const Eigen::MatrixXd dense = dense_band(50, 6);
  Eigen::MatrixXd x(50, 2);
  for (int i = 0; i < x.size(); ++i) x.data()[i] = std::cos(2.0 * i);
  EXPECT_LT((product(sparse(dense), x) - dense * x).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(SparseFactor, RefusesWhatIsNotPositiveDefinite) {
  Eigen::MatrixXd dense = dense_band(20, 3);
  dense(11, 11) = -1.0;
  EXPECT_THROW(SparseFactor{sparse(dense)}, NumericalError);
}

TEST(SparseFactor, RefusesByEstimateWhatWouldNotFit) {
  const SymmetricMatrix matrix = sparse(dense_band(200, 20));
  EXPECT_THROW(SparseFactor(matrix, {.memory_bytes = 8.0 * 200.0, .operations = 1e9}), ResourceError);
  EXPECT_THROW(SparseFactor(matrix, {.memory_bytes = 1e9, .operations = 1000.0}), ResourceError);
}

}  // namespace
}  // namespace ostia::lumen
