#pragma once
/// \file The motion experiment's plots.

#include "ostia/experiments/motion.h"
#include "ostia/figure/picture.h"

#include <functional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// How a row is called in tables and legends: "cage, depth 4, odd 10".
std::string name_of(MotionMethod method, int depth, const std::string& sampling);

/// Dice and distance over the phase, a curve for each kind of run among those chosen, means over hearts.
figure::Picture pair_of_plots(const std::vector<MotionRun>& runs, const std::string& title,
                              const std::function<bool(const MotionRun&)>& chosen);
/// Stretch and size of the torsion, known and fitted: the longest branches of the first heart there is, each
/// a colour. Not for none.
figure::Picture branch_plots(const std::vector<BranchRun>& branches);

}  // namespace ostia::experiments
