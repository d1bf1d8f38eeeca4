#include "interpolation/sparse_factor.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <cholmod.h>

#include <cstring>
#include <new>
#include <string>

namespace ostia::lumen {
namespace {

cholmod_sparse view_of(const SymmetricMatrix& matrix) {
  cholmod_sparse view{};
  view.nrow = view.ncol = static_cast<std::size_t>(matrix.size);
  view.nzmax = matrix.row.size();
  // CHOLMOD does not write to its input.
  view.p = const_cast<int*>(matrix.column_start.data());
  view.i = const_cast<int*>(matrix.row.data());
  view.x = const_cast<double*>(matrix.value.data());
  view.stype = -1;
  view.itype = CHOLMOD_INT;
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  view.sorted = 1;
  view.packed = 1;
  return view;
}

void check(const cholmod_common& common, const cholmod_factor* factor, const FactorLimits& limits) {
  if (common.status == CHOLMOD_OUT_OF_MEMORY || common.status == CHOLMOD_TOO_LARGE || factor == nullptr)
    throw ResourceError("no memory is left for the analysis of a wall's system; reduce its support radius");
  const double bytes = 8.0 * common.lnz;
  if (bytes > limits.memory_bytes)
    throw ResourceError("the factor of a wall's system would take " +
                        core::rounded_text(bytes / (1 << 20), 0) + " MiB, more than " +
                        core::rounded_text(limits.memory_bytes / (1 << 20), 0) +
                        " MiB; reduce the support radius or the number of samples");
  if (common.fl > limits.operations)
    throw ResourceError("the factor of a wall's system would take " +
                        core::rounded_text(1e-9 * common.fl, 0) + "e9 operations, more than " +
                        core::rounded_text(1e-9 * limits.operations, 0) +
                        "e9; reduce the support radius or the number of samples");
}

}  // namespace

Eigen::MatrixXd product(const SymmetricMatrix& matrix, const Eigen::MatrixXd& x) {
  Eigen::MatrixXd result = Eigen::MatrixXd::Zero(x.rows(), x.cols());
  for (Eigen::Index k = 0; k < x.cols(); ++k) {
    const double* in = x.col(k).data();
    double* out = result.col(k).data();
    for (int j = 0; j < matrix.size; ++j) {
      const auto from = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(j)]);
      const auto to = static_cast<std::size_t>(matrix.column_start[static_cast<std::size_t>(j) + 1]);
      double sum = matrix.value[from] * in[j];
      for (std::size_t e = from + 1; e < to; ++e) {
        sum += matrix.value[e] * in[matrix.row[e]];
        out[matrix.row[e]] += matrix.value[e] * in[j];
      }
      out[j] += sum;
    }
  }
  return result;
}

struct SparseFactor::Impl {
  mutable cholmod_common common{};
  cholmod_factor* factor = nullptr;
  double nonzeros = 0.0, operations = 0.0;

  Impl() {
    cholmod_start(&common);
    common.print = 0;
    common.nmethods = 1;
    common.method[0].ordering = CHOLMOD_NATURAL;
    common.postorder = 1;
    common.supernodal = CHOLMOD_SUPERNODAL;
    common.final_ll = 1;
  }
  ~Impl() {
    if (factor != nullptr) cholmod_free_factor(&factor, &common);
    cholmod_finish(&common);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;
};

SparseFactor::SparseFactor(const SymmetricMatrix& matrix, const FactorLimits& limits)
    : impl_(std::make_unique<Impl>()) {
  cholmod_sparse view = view_of(matrix);
  impl_->factor = cholmod_analyze(&view, &impl_->common);
  check(impl_->common, impl_->factor, limits);
  impl_->nonzeros = impl_->common.lnz;
  impl_->operations = impl_->common.fl;
  cholmod_factorize(&view, impl_->factor, &impl_->common);
  if (impl_->common.status == CHOLMOD_OUT_OF_MEMORY)
    throw ResourceError("no memory is left for the factor of a wall's system; reduce its support radius");
  if (impl_->common.status != CHOLMOD_OK || impl_->factor->minor < static_cast<std::size_t>(matrix.size))
    throw NumericalError(
        "the system of a wall is not positive definite to working precision: samples are too "
        "near to each other for the support radius; remove some or reduce it");
}
SparseFactor::~SparseFactor() = default;
SparseFactor::SparseFactor(SparseFactor&&) noexcept = default;
SparseFactor& SparseFactor::operator=(SparseFactor&&) noexcept = default;

Eigen::MatrixXd SparseFactor::solve(const Eigen::MatrixXd& right) const {
  cholmod_dense view{};
  view.nrow = static_cast<std::size_t>(right.rows());
  view.ncol = static_cast<std::size_t>(right.cols());
  view.nzmax = view.nrow * view.ncol;
  view.d = view.nrow;
  view.x = const_cast<double*>(right.data());
  view.xtype = CHOLMOD_REAL;
  view.dtype = CHOLMOD_DOUBLE;
  cholmod_dense* solution = cholmod_solve(CHOLMOD_A, impl_->factor, &view, &impl_->common);
  if (solution == nullptr) throw ResourceError("no memory is left to solve a wall's system");
  Eigen::MatrixXd result(right.rows(), right.cols());
  std::memcpy(result.data(), solution->x, sizeof(double) * static_cast<std::size_t>(right.size()));
  cholmod_free_dense(&solution, &impl_->common);
  return result;
}

double SparseFactor::nonzeros() const {
  return impl_->nonzeros;
}
double SparseFactor::operations() const {
  return impl_->operations;
}

}  // namespace ostia::lumen
