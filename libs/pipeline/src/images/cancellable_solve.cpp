#include "images/cancellable_solve.h"

namespace ostia::pipeline {

Eigen::VectorXd solved(const Eigen::SparseMatrix<double, Eigen::RowMajor>& matrix,
                       const Eigen::VectorXd& right, double tolerance, const core::TaskContext& task) {
  constexpr Eigen::Index rounds_between_looks = 16;
  const Eigen::VectorXd inverse = matrix.diagonal().cwiseInverse();
  const double enough = tolerance * tolerance * right.squaredNorm();
  Eigen::VectorXd found = Eigen::VectorXd::Zero(right.size());
  Eigen::VectorXd residual = right, way = inverse.cwiseProduct(residual);
  double size = residual.dot(way);
  for (Eigen::Index round = 0; round < right.size() && residual.squaredNorm() > enough; ++round) {
    if (round % rounds_between_looks == 0) task.throw_if_cancelled();
    const Eigen::VectorXd image = matrix * way;
    const double share = size / way.dot(image);
    found += share * way;
    residual -= share * image;
    const Eigen::VectorXd scaled = inverse.cwiseProduct(residual);
    const double next = residual.dot(scaled);
    way = scaled + (next / size) * way;
    size = next;
  }
  return found;
}

}  // namespace ostia::pipeline
