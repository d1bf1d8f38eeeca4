#pragma once
/// \file The part of a tree's motion that all its branches have in common.

#include "ostia/analysis/moving_tree.h"

namespace ostia::analysis {

/// Of the motion, what is larger than this is kept and what is smaller is not, mm.
inline constexpr double common_length_mm = 80.0;

/// Places of each branch's points, [branch][phase][point], mm: at rest plus a displacement field that is
/// smooth over `common_length_mm` in space. The field is the mean of a Gaussian process (Rasmussen and
/// Williams, Gaussian Processes for Machine Learning, 2006, eq. 2.23: an affine part, and a squared
/// exponential of that length), given the displacements (of MovingBranch::shape, else `places`) at 250 places
/// at most, evenly along the branches, each known to 0.3 mm across the axis and to 1 mm along it: surfaces
/// tell hardly how far a vessel has gone along itself. Where nothing moves the places are those at rest.
/// Throws Cancelled.
std::vector<PhasePoints> smooth_motion(const MovingTree& tree,
                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::analysis
