#pragma once
/// \file A cage's displacements without kinks between its cells.

#include "ostia/geometry/cage.h"

#include <array>
#include <vector>

namespace ostia::analysis {

/// Points at rest whose displacement is the mean of 64 control points' about them with the weights of uniform
/// cubic B-splines: C2 everywhere, the displacements themselves where they are linear. Trilinear weights have
/// kinks at the faces of cells, which bends and torsion would show. Beyond the cage the displacement is its
/// border's.
class SmoothCage {
 public:
  explicit SmoothCage(const geometry::CageGrid& grid) : grid_(grid) {}
  struct Weights {
    std::array<int, 3> first{};  ///< of four control points along each axis; may begin one before the grid
    std::array<std::array<double, 4>, 3> along{};
  };
  Weights weights(const geometry::Vec3& rest) const;
  /// mm; `displacements` of all control points.
  geometry::Vec3 displacement(const Weights& weights, const std::vector<geometry::Vec3>& displacements) const;

 private:
  geometry::CageGrid grid_;
};

}  // namespace ostia::analysis
