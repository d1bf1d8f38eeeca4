#pragma once
/// \file Words that the parts of a motion's report share.

#include "ostia/analysis/motion_measures.h"

#include <string>
#include <vector>

namespace ostia::pipeline::motion_text {

std::string pair_name(const analysis::TreeMotion& motion, const analysis::BranchDistance& pair);
std::string rests_text(const std::vector<analysis::RestPeriod>& rests, double rr_s);

}  // namespace ostia::pipeline::motion_text
