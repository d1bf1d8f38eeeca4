#pragma once
/// \file Which artery supplies the back of the heart, by the standard segments (SCCT, Leipsic et al. 2014).

#include "ostia/analysis/aha_segments.h"

#include <string>
#include <vector>

namespace ostia::analysis {

/// By the artery that the posterior descending and posterolateral branches come from.
enum class Dominance { unknown, right, left, codominant };
std::string to_string(Dominance dominance);    ///< "unknown", "right", "left", "co-dominant"
Dominance dominance(const std::string& text);  ///< of to_string; throws InvalidInput
/// Of the segments that are there: left with L-PDA (15) and no R-PDA (4); co-dominant with R-PDA and L-PDA or
/// L-PLB (18); right with R-PDA alone; else unknown.
Dominance dominance_of(const std::vector<VesselSegment>& segments);

}  // namespace ostia::analysis
