#pragma once
/// \file Which way of making a joint leaves its surface without crossings.

#include "joint.h"

namespace ostia::reconstruction {

/// For each of these points of the graph (ascending) the first of a few styles whose joint, with its branches
/// cut off not far from it, has no crossing at this level, at least 1, or else the one with the fewest.
/// Points whose best style is JointStyle() are left out. Each joint is looked at by itself. Throws Cancelled.
JointStyles chosen_styles(const std::vector<Joint>& joints, const std::vector<std::int32_t>& points,
                          const std::vector<Tube>& tubes, const ReconstructionOptions& options, int level,
                          const core::TaskContext& task);

}  // namespace ostia::reconstruction
