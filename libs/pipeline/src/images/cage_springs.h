#pragma once
/// \file Springs between the control points of a cage.

#include "ostia/geometry/cage.h"

#include <Eigen/SparseCore>

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::pipeline {

/// Against bending of a cage's whole displacement and stretching of one level's. `begin` is the whole cage
/// where the level began, `moved` the level's own displacements.
class CageSprings {
 public:
  /// `level` is a grid of half as many cells a side as `whole`, or a quarter, and so on.
  CageSprings(const geometry::CageGrid& level, const geometry::CageGrid& whole);
  /// Gauss-Newton's terms, each spring's stiffness times `stiffness`.
  void add(double stiffness, const std::vector<geometry::Vec3>& begin,
           const std::vector<geometry::Vec3>& moved, std::vector<Eigen::Triplet<double>>& entries,
           Eigen::VectorXd& right) const;
  /// Twice the energy.
  double energy(double stiffness, const std::vector<geometry::Vec3>& begin,
                const std::vector<geometry::Vec3>& moved) const;

 private:
  /// `stiffness` |sum of factors times displacements|^2 / 2.
  struct Spring {
    std::array<std::int32_t, 3> points{};
    std::array<double, 3> factors{};
    double stiffness = 0.0;
    bool of_whole = false;  ///< of the whole displacement
  };
  std::vector<geometry::Vec3> whole_displacement(const std::vector<geometry::Vec3>& begin,
                                                 const std::vector<geometry::Vec3>& moved) const;
  const geometry::CageGrid& level_;
  const geometry::CageGrid& whole_;
  std::vector<Spring> springs_;
};

}  // namespace ostia::pipeline
