#pragma once
/// \file Rules by which branches of the main coronary arteries get their names.

#include "naming_rules.h"

#include <vector>

namespace ostia::coronary {

/// A path that leaves another which has its kind already, or begins at a root beside the RCA's.
void name_branch(const std::vector<TreePath>& paths, const MainVessels& main, std::vector<PathName>& names,
                 int branch);

/// Of the branches that run down behind, the posterior descending one and those before and beyond it.
void settle_posterior(const std::vector<TreePath>& paths, std::vector<PathName>& names);

}  // namespace ostia::coronary
