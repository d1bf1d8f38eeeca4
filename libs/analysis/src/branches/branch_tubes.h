#pragma once
/// \file Which branch a place belongs to.

#include "branches/branch_tracts.h"

#include "ostia/geometry/ball_line.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

/// The tubes of all branches (not of bifurcations). Asked from many threads.
class BranchTubes {
 public:
  explicit BranchTubes(const BranchTracts& tracts);
  /// How deep a place lies in a branch's tube (geometry::BallLine); infinite for what is none.
  double value(std::int32_t group, const geometry::Vec3& x) const;
  /// The branch in whose tube it lies deepest.
  std::int32_t nearest(const geometry::Vec3& x) const;
  std::vector<std::int32_t> nearest(const std::vector<geometry::Vec3>& places) const;

 private:
  struct Tube {
    std::int32_t group = 0;
    std::vector<geometry::BallLine> lines;
  };
  static double value(const Tube& tube, const geometry::Vec3& x);
  std::vector<Tube> tubes_;
};

}  // namespace ostia::analysis
