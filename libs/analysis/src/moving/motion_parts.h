#pragma once
/// \file What measure_motion is put together from.

#include "ostia/analysis/motion_measures.h"

namespace ostia::analysis {

/// Where lengths, bends and angles are taken from.
const PhasePoints& shape_of(const MovingBranch& branch);

/// Each point's share of the branch's length at the template; their sum is 1.
std::vector<double> length_shares(const std::vector<double>& s_mm);

/// Everything but rest periods. `common`: its points by the motion that all branches have in common
/// (smooth_motion).
BranchMotion branch_motion(const MovingBranch& branch, const PhasePoints& common,
                           const MotionMeasureOptions& options, std::vector<std::string>& warnings);

/// Mean distance between places at each two phases, weighted by length: [phase][phase], mm.
using PhaseDistances = std::vector<std::vector<double>>;
PhaseDistances phase_distances(const MovingBranch& branch);

/// Periods in which no two phases are farther from each other than `bound_mm`: from a phase on as far as
/// distances allow, linear between phases. Of those that overlap the longest, where neither neighbour begins
/// a longer one; four at most.
std::vector<RestPeriod> rest_periods(const PhaseDistances& distances, const std::vector<double>& phases,
                                     double bound_mm);

std::vector<BranchDistance> branch_distances(const MovingTree& tree, const MotionMeasureOptions& options,
                                             const core::TaskContext& task);

std::vector<JointAngle> joint_angles(const MovingTree& tree, const MotionMeasureOptions& options,
                                     std::vector<std::string>& warnings);

}  // namespace ostia::analysis
