#pragma once
/// \file What it costs to deform a cell of a cage: changes of length, area and volume ([Yi] 3.4).

#include "ostia/geometry/vec.h"

#include <array>

namespace ostia::motion {

/// Of the three terms of [Yi] equation 21; 10 each in the paper.
struct HyperelasticWeights {
  double length = 10.0, area = 10.0, volume = 10.0;
};

/// The point inside a quadrilateral whose four triangles with the sides have areas as equal as can be: least
/// sum of squared areas ([Yi] equations 22 and 23).
geometry::Vec3 equal_area_point(const std::array<geometry::Vec3, 4>& quad);

/// A cell's points: its eight corners (as geometry::CageCell), six face points, one volume point ([Yi] figure
/// 5).
using CellPoints = std::array<geometry::Vec3, 15>;
/// Adds face points of equal area and the volume point whose 24 tetrahedra have volumes as equal as can be
/// ([Yi] equations 24 and 25).
CellPoints cell_points(const std::array<geometry::Vec3, 8>& corners);

/// The 24 tetrahedra of a cell as numbers into CellPoints; positive volume (p1-p0) x (p2-p0) . (p3-p0).
const std::array<std::array<int, 4>, 24>& cell_tetrahedra();

/// With corners' coordinates together: x0 y0 z0 x1 ...
struct CellEnergy {
  double energy = 0.0;  ///< mm3 times the weights; infinite where a tetrahedron is inverted or flat
  Eigen::Matrix<double, 24, 1> gradient = Eigen::Matrix<double, 24, 1>::Zero();
  /// Positive semi-definite approximation of the second derivatives (Gauss-Newton: what is left out are
  /// products with second derivatives of areas, volumes and of the inner points).
  Eigen::Matrix<double, 24, 24> hessian = Eigen::Matrix<double, 24, 24>::Zero();
};

enum class Derivatives { none, first, second };

/// Hyperelastic energy of a deformed box: the integral over its 24 tetrahedra, with constant deformation
/// gradient F in each, of (Burger, Modersitzki and Ruthotto 2013)
///
///     length/2 |F - 1|^2 + area sum_i max(|cof F e_i|^2 - 1, 0)^2 + volume ((det F - 1)^2 / det F)^2.
///
/// Gradients are exact, with the motion of face and volume points in them.
class ElasticCell {
 public:
  /// The size of the box at rest: what all cells of a grid have in common.
  explicit ElasticCell(const geometry::Vec3& cell_mm);
  /// Of the box deformed to eight corners.
  CellEnergy energy(const std::array<geometry::Vec3, 8>& corners, const HyperelasticWeights& weights,
                    Derivatives derivatives) const;

 private:
  double tetrahedron_mm3_;
  std::array<geometry::Mat3, 24> inverse_;  ///< of the tetrahedra's edges
};

}  // namespace ostia::motion
