#pragma once
/// \file Stretch, torsion and curvature of a fitted motion's branches beside those of the known one.

#include "ostia/experiments/motion.h"
#include "ostia/geometry/cage.h"

namespace ostia::experiments {

/// `control_points`: of all phases of the heart, in their order. Branches too short to be measured are left
/// out. Throws Cancelled.
std::vector<BranchRun> branch_runs(const BeatingHeart& heart, const geometry::CageGrid& grid,
                                   const std::vector<std::vector<geometry::Vec3>>& control_points,
                                   const core::TaskContext& task);

}  // namespace ostia::experiments
