#include "motion/kernel_deformation.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <Eigen/QR>

#include <cmath>

namespace ostia::experiments {
namespace {

using Eigen::Index;
using Eigen::VectorXd;
using geometry::Vec3;

constexpr std::size_t block = 128;  // rows of a matrix at a time

auto rows_of(std::size_t first, std::size_t last) {
  return Eigen::seqN(static_cast<Index>(first), static_cast<Index>(last - first));
}

/// matrix * right, block by block of rows.
template <class Matrix>
Coordinates product(const Matrix& matrix, const Coordinates& right) {
  Coordinates out(matrix.rows(), 3);
  core::parallel_chunks(
      static_cast<std::size_t>(matrix.rows()), block, [&](std::size_t first, std::size_t last) {
        const auto rows = rows_of(first, last);
        out(rows, Eigen::all).noalias() =
            matrix.middleRows(static_cast<Index>(first), static_cast<Index>(last - first)) * right;
      });
  return out;
}

template <class Matrix>
Coordinates transposed_product(const Matrix& matrix, const Coordinates& right) {
  const Coordinates zero = Coordinates::Zero(matrix.cols(), 3);
  return core::parallel_reduce(
      static_cast<std::size_t>(matrix.rows()), 4 * block, zero,
      [&](std::size_t first, std::size_t last) {
        const auto from = static_cast<Index>(first), count = static_cast<Index>(last - first);
        return Coordinates(matrix.middleRows(from, count).transpose() * right.middleRows(from, count));
      },
      [](Coordinates a, const Coordinates& b) {
        a += b;
        return a;
      });
}

}  // namespace

Coordinates coordinates(const std::vector<Vec3>& points) {
  Coordinates out(static_cast<Index>(points.size()), 3);
  for (std::size_t i = 0; i < points.size(); ++i) out.row(static_cast<Index>(i)) = points[i].transpose();
  return out;
}

double KernelDeformation::kernel(double squared) const {
  if (kind_ == DeformationKind::thin_plate_spline) return -std::sqrt(squared);
  return std::exp(-squared / (2.0 * width_ * width_));
}

KernelDeformation::KernelDeformation(DeformationKind kind, const std::vector<Vec3>& control_points,
                                     double width)
    : kind_(kind), width_(width), control_(coordinates(control_points)) {
  if (control_points.size() < 5) throw InvalidInput("a deformation by kernels needs five control points");
  Eigen::MatrixXd affine(control_.rows(), 4);
  affine << VectorXd::Ones(control_.rows()), control_;
  affine_ = Eigen::HouseholderQR<Eigen::MatrixXd>(affine).householderQ() *
            Eigen::MatrixXd::Identity(control_.rows(), 4);
  among_ = prepared(control_points).kernels;
}

KernelDeformation::Prepared KernelDeformation::prepared(const std::vector<Vec3>& points) const {
  Prepared cloud{coordinates(points), {}};
  cloud.kernels.resize(cloud.points.rows(), control_.rows());
  core::parallel_for(points.size(), block, [&](std::size_t i) {
    const auto row = static_cast<Index>(i);
    for (Index j = 0; j < control_.rows(); ++j)
      cloud.kernels(row, j) = kernel((cloud.points.row(row) - control_.row(j)).squaredNorm());
  });
  return cloud;
}

Coordinates KernelDeformation::without_affine(Coordinates weights) const {
  if (affine_rows() > 0) weights -= affine_ * (affine_.transpose() * weights).eval();
  return weights;
}

Coordinates KernelDeformation::weights(const VectorXd& unknowns) const {
  return without_affine(unknowns.reshaped(rows(), 3).bottomRows(control_.rows()));
}

Coordinates KernelDeformation::moved(const Prepared& cloud, const VectorXd& unknowns) const {
  Coordinates out = cloud.points + product(cloud.kernels, weights(unknowns));
  if (affine_rows() == 0) return out;
  const auto map = unknowns.reshaped(rows(), 3).topRows<4>();
  out.rowwise() += map.row(0);
  out += cloud.points * map.bottomRows<3>();
  return out;
}

VectorXd KernelDeformation::gradient(const Prepared& cloud, const Coordinates& by_points) const {
  Coordinates out(rows(), 3);
  out.bottomRows(control_.rows()) = without_affine(transposed_product(cloud.kernels, by_points));
  if (affine_rows() > 0) {
    out.row(0) = by_points.colwise().sum();
    out.middleRows<3>(1) = cloud.points.transpose() * by_points;
  }
  return out.reshaped();
}

double KernelDeformation::bending(const VectorXd& unknowns, VectorXd& gradient) const {
  const Coordinates w = weights(unknowns), pulled = product(among_, w);
  Coordinates by = Coordinates::Zero(rows(), 3);
  by.bottomRows(control_.rows()) = 2.0 * without_affine(pulled);
  gradient = by.reshaped();
  return (w.array() * pulled.array()).sum();
}

}  // namespace ostia::experiments
