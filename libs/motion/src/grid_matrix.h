#pragma once
/// \file Equations between the points of a regular grid and their neighbours.

#include "ostia/geometry/vec.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::motion {

/// The block of a neighbour `dx`, `dy`, `dz` steps (-1, 0, 1) away.
constexpr std::size_t block_at(int dx, int dy, int dz) {
  return static_cast<std::size_t>(13 + dx + 3 * dy + 9 * dz);
}

/// A symmetric matrix of 3 x 3 blocks: each unknown point with itself and its 26 neighbours.
struct GridMatrix {
  static constexpr std::size_t row_blocks = 27;
  static constexpr std::size_t diagonal = block_at(0, 0, 0);

  /// Numbers of the neighbours, -1 where there is none; the same for all matrices of a grid.
  const std::vector<std::array<std::int32_t, row_blocks>>& neighbours;
  std::vector<geometry::Mat3> blocks;  ///< row_blocks for each unknown

  explicit GridMatrix(const std::vector<std::array<std::int32_t, row_blocks>>& neighbours_of_unknowns);
};

/// Solves matrix x = right by conjugate gradients, preconditioned by the inverse diagonal blocks, until the
/// residual is `tolerance` of the right side, or after `most` steps. The matrix must be positive definite.
/// The same bits for any number of threads.
std::vector<geometry::Vec3> solved(const GridMatrix& matrix, const std::vector<geometry::Vec3>& right,
                                   double tolerance, int most);

}  // namespace ostia::motion
