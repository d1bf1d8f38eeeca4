#pragma once
/// \file One level of a cage brought into another image, by least squares.

#include "images/cage_springs.h"
#include "images/image_cage.h"

#include <Eigen/SparseCore>

#include <vector>

namespace ostia::pipeline {

constexpr double least_noise_hu = 5.0;
constexpr double least_jacobian = 0.05;  // of a cell that a step may leave behind

double least_jacobian_of(const geometry::CageGrid& grid, const std::vector<geometry::Vec3>& points);

/// One level's least squares: displacements of its control points beyond where it began. What it is made of
/// must outlive it.
class ImageCageSolver {
 public:
  ImageCageSolver(const ImageCageLevel& level, const geometry::CageGrid& grid,
                  const geometry::CageGrid& whole, const imaging::FloatVolume& image);
  /// `control_points` of the whole grid, improved.
  void run(std::vector<geometry::Vec3>& control_points, const core::TaskContext& task) const;
  /// The image's at the level's places, carried.
  std::vector<double> values(const std::vector<geometry::Vec3>& control_points) const;
  /// From the template's own.
  std::vector<double> differences(const std::vector<geometry::Vec3>& control_points) const;
  static double cost_of(const std::vector<double>& differences, double noise);  ///< Huber's

 private:
  using Matrix = Eigen::SparseMatrix<double, Eigen::RowMajor>;
  struct System {
    Matrix matrix;
    Eigen::VectorXd right;
    double stiffness = 0.0;  ///< of the springs: the mean diagonal of the images' terms
  };
  struct CellTerms {
    Eigen::Matrix<double, 24, 24> hessian = Eigen::Matrix<double, 24, 24>::Zero();
    Eigen::Matrix<double, 24, 1> gradient = Eigen::Matrix<double, 24, 1>::Zero();
  };
  /// The cage `begin` with this level's displacements.
  std::vector<geometry::Vec3> added(const std::vector<geometry::Vec3>& begin,
                                    const std::vector<geometry::Vec3>& moved) const;
  CellTerms terms_of(std::size_t cell, const std::vector<geometry::Vec3>& control_points,
                     const std::vector<double>& off, double noise) const;
  /// Gauss-Newton's equations with springs between neighbouring control points.
  System system_of(const std::vector<geometry::Vec3>& begin,
                   const std::vector<geometry::Vec3>& control_points,
                   const std::vector<geometry::Vec3>& moved, const std::vector<double>& off,
                   double noise) const;

  const ImageCageLevel& level_;
  const geometry::CageGrid& grid_;
  const geometry::CageGrid& whole_;
  const imaging::FloatVolume& image_;
  CageSprings springs_;
};

}  // namespace ostia::pipeline
