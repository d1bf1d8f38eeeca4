#pragma once
/// \file Face and volume points of a cell, and how they move with its corners.

#include "ostia/motion/hyperelastic.h"

namespace ostia::motion {

/// Corners of the six faces, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> cell_faces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

using PointMotion = Eigen::Matrix<double, 45, 24>;  ///< of CellPoints by the corners

/// Derivatives of `points`, which cell_points has made, by the corners.
PointMotion point_motion(const CellPoints& points);

}  // namespace ostia::motion
