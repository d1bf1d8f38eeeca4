#pragma once
/// \file Coordinates along and around a branch.

#include "branches/branch_tracts.h"

#include "ostia/geometry/ball_line.h"

#include <vector>

namespace ostia::analysis {

struct BranchPlace {
  double abscissa_mm = 0.0, angle_rad = 0.0, distance_mm = 0.0;
};

/// A branch with the bifurcations at its ends. Asked from many threads.
class BranchMetrics {
 public:
  BranchMetrics(const geometry::BranchedLines& lines, const BranchTracts& tracts, std::int32_t group);
  /// At the axis' ball in which a place lies deepest; means over the branch's lines, weighted by the radii's
  /// squares. The angle is right-handed about the axis taken upstream, from the parallel-transport normal, as
  /// VMTK's AngularMetric and geometry::radial_direction have it, in (-pi, pi].
  BranchPlace at(const geometry::Vec3& x) const;

 private:
  struct Line {
    geometry::Centerline axis;
    geometry::BallLine tube;
  };
  std::vector<Line> lines_;
};

}  // namespace ostia::analysis
