#pragma once
/// \file A regular cage of boxes around a shape, which is deformed with it ([Yi] 3.1).

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::geometry {

/// Corners of a cell: bit 0 of a corner's number is the step along x, bit 1 along y, bit 2 along z.
using CageCell = std::array<std::int32_t, 8>;

/// The cage at rest: `cells` boxes along each axis, control points at their corners, x fastest.
struct CageGrid {
  Vec3 origin = Vec3::Zero();  ///< the least corner, mm
  Vec3 cell_mm = Vec3::Ones();
  int cells = 1;  ///< along each axis

  int points_a_side() const { return cells + 1; }
  std::size_t point_count() const;
  std::size_t cell_count() const;
  std::int32_t point(int i, int j, int k) const { return i + points_a_side() * (j + points_a_side() * k); }
  Vec3 place(std::int32_t point) const;
  CageCell corners(std::size_t cell) const;
};

/// A grid of 2^depth cells a side around points, `margin` of the longest side wider on all sides, no side
/// thinner than a tenth of the longest. Throws InvalidInput (no points, not finite, depth not in [0, 8]).
CageGrid cage_around(const std::vector<Vec3>& points, int depth, double margin = 0.1);

/// A point as a mean of a cell's corners with trilinear weights ([Yi] equations 3 and 4).
struct CagePoint {
  std::uint32_t cell = 0;
  std::array<double, 8> weights{};
};
/// Points outside get the weights of the nearest point of the box.
CagePoint cage_point(const CageGrid& grid, const Vec3& point);
/// The point moved with the cage: sum of weights times control points.
Vec3 carried(const CageGrid& grid, const CagePoint& point, const std::vector<Vec3>& control_points);

/// Control points at rest.
std::vector<Vec3> rest_points(const CageGrid& grid);
/// The same deformation on the grid of twice as many cells a side, exactly ([Yi] equation 16).
std::vector<Vec3> refined(const CageGrid& grid, const std::vector<Vec3>& control_points);
CageGrid refined(const CageGrid& grid);

/// Bounds of the Jacobian determinant of the trilinear map of a box to eight corners, over the box's volume:
/// the least and the greatest of its 27 Bernstein coefficients (degree 2 along each axis). The determinant
/// lies between them everywhere inside; a positive first value proves that nothing is inverted.
std::array<double, 2> jacobian_bounds(const std::array<Vec3, 8>& corners, const Vec3& cell_mm);

}  // namespace ostia::geometry
