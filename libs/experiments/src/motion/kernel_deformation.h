#pragma once
/// \file Deformations of space by kernels at control points, linear in their unknowns.

#include "ostia/experiments/mixture_deformation.h"

#include <Eigen/Core>

#include <vector>

namespace ostia::experiments {

/// Three columns, x y z; a row for each point.
using Coordinates = Eigen::Matrix<double, Eigen::Dynamic, 3>;
Coordinates coordinates(const std::vector<geometry::Vec3>& points);

/// Unknowns: three columns one after the other; for thin plates four rows of an affine map (of 1, x, y, z),
/// then a weight for each control point, for Gaussians these alone. All zero: nothing moves.
class KernelDeformation {
 public:
  /// `width` of the Gaussians. Throws InvalidInput where there are no control points.
  KernelDeformation(DeformationKind kind, const std::vector<geometry::Vec3>& control_points, double width);
  Eigen::Index unknowns() const { return 3 * rows(); }

  /// What a cloud needs to be moved again and again: memory for points times control points.
  struct Prepared {
    Coordinates points;
    Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> kernels;
  };
  Prepared prepared(const std::vector<geometry::Vec3>& points) const;
  Coordinates moved(const Prepared& cloud, const Eigen::VectorXd& unknowns) const;
  /// The derivative by the unknowns of what has the derivative `by_points` by the points that `moved` gives.
  Eigen::VectorXd gradient(const Prepared& cloud, const Coordinates& by_points) const;

  /// Bending energy (thin plates), norm of the kernels' space (Gaussians); never negative.
  double bending(const Eigen::VectorXd& unknowns, Eigen::VectorXd& gradient) const;

 private:
  Eigen::Index affine_rows() const { return kind_ == DeformationKind::thin_plate_spline ? 4 : 0; }
  Eigen::Index rows() const { return affine_rows() + control_.rows(); }
  double kernel(double squared_distance) const;
  /// Weights that move nothing affinely: bending energy is finite for these alone.
  Coordinates without_affine(Coordinates weights) const;
  Coordinates weights(const Eigen::VectorXd& unknowns) const;

  DeformationKind kind_;
  double width_;
  Coordinates control_;
  Eigen::Matrix<double, Eigen::Dynamic, 4> affine_;  ///< orthonormal, what affine maps do at control points
  Eigen::MatrixXd among_;                            ///< kernels between control points
};

}  // namespace ostia::experiments
