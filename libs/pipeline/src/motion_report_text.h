#pragma once
/// \file Words and numbers that the parts of a motion's report share.

#include "ostia/analysis/motion_measures.h"

#include <string>
#include <vector>

namespace ostia::pipeline::motion_text {

std::string number(double value);               ///< seven digits; empty where it is not finite
std::string fixed(double value, int decimals);  ///< "-" where it is not finite
std::string pair_name(const analysis::TreeMotion& motion, const analysis::BranchDistance& pair);
std::string rests_text(const std::vector<analysis::RestPeriod>& rests, double rr_s);

}  // namespace ostia::pipeline::motion_text
