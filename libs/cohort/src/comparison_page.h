#pragma once
/// \file A comparison of two cohorts as a page.

#include "ostia/cohort/cohort_comparison.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::cohort {

/// A scan that changed, for the list of those that changed most.
struct ChangedScan {
  double amount = 0.0;        ///< the greatest difference, in steps of its measure's distribution
  std::string before, after;  ///< pseudonyms
  std::vector<std::array<std::string, 3>> values;  ///< what, before, after
  std::array<std::string, 2> pictures;             ///< names in the page's folder; empty: there is none
};

std::string comparison_page(const CohortComparison& comparison, const std::vector<ChangedScan>& most);

}  // namespace ostia::cohort
