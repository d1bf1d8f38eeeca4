#pragma once
/// \file The sparse Cholesky factor of a symmetric positive definite matrix.

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <vector>

namespace ostia::lumen {

/// The lower triangle by columns, rows ascending, the diagonal first.
struct SymmetricMatrix {
  int size = 0;
  std::vector<int> column_start, row;  ///< of size + 1, and one a stored value
  std::vector<double> value;
};
Eigen::MatrixXd product(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x);

/// What a factor may take; beyond it ResourceError tells before the work begins.
struct FactorLimits {
  double memory_bytes = 2.0 * (1ULL << 30);
  double operations = 5e11;  ///< floating-point, of the factorisation: some minutes
};

/// A = P^T L L^T P by CHOLMOD's supernodal factorisation, in the order of the matrix (but for a
/// postordering).
class SparseFactor {
 public:
  /// Throws ResourceError by the analysis of the pattern, NumericalError if it is not positive definite.
  explicit SparseFactor(const SymmetricMatrix& matrix, const FactorLimits& limits = {});
  ~SparseFactor();
  SparseFactor(SparseFactor&&) noexcept;
  SparseFactor& operator=(SparseFactor&&) noexcept;

  Eigen::MatrixXd solve(const Eigen::MatrixXd& right) const;
  double nonzeros() const;    ///< of L
  double operations() const;  ///< floating-point, of the factorisation

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace ostia::lumen
