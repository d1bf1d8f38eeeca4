#pragma once
/// \file What the files of a comparison share.

#include "ostia/session/comparison.h"

#include <string>
#include <vector>

namespace ostia::session {

std::string compared_vessel_name(const ComparedCase& of, std::int32_t vessel);
/// "S1 -> S2" (with an arrow), "S3 (new)", "S1, S2 -> S1": what a reader finds it by.
std::string compared_label(const Comparison& made, const analysis::LesionChange& lesion);
/// before, after, change, smallest real difference, verdict; empty where not known.
std::vector<std::string> difference_cells(const analysis::Difference& one);

std::string repeatability_json(const analysis::Repeatability& table);

}  // namespace ostia::session
