#pragma once
/// \file Made by scripts/repeatability_table.py, not by hand (docs/methods/compare.md).

#include "ostia/analysis/repeatability.h"

namespace ostia::analysis {

inline constexpr const char* repeatability_from = "not measured yet";
/// Standard deviation and share of the mean, by scope and measure.
inline constexpr double repeatability_table[change_scope_count][change_measure_count][2] = {};

}  // namespace ostia::analysis
