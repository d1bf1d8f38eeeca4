#pragma once
/// \file Face and volume points of a cell, and how they move with its corners.

#include "ostia/motion/hyperelastic.h"

namespace ostia::motion {

/// Corners of the six faces, counter-clockwise seen from outside.
inline constexpr std::array<std::array<int, 4>, 6> cell_faces = {
    {{0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}, {0, 2, 3, 1}, {4, 5, 7, 6}}};

/// Derivatives of the inner points by the corners.
struct InnerMotion {
  std::array<std::array<geometry::Mat3, 4>, 6> face;  ///< of a face's point by the corners in cell_faces
  Eigen::Matrix<double, 3, 24> volume;                ///< of the volume point, by all corners
};
/// For `points`, which cell_points has made.
InnerMotion inner_motion(const CellPoints& points);

}  // namespace ostia::motion
