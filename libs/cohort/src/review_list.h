#pragma once
/// \file What persons said, as the cohort's page reads it.

#include "stage_results.h"

#include <string>

namespace ostia::cohort {

/// The last review of each scan whose case is, as far as is known, the one that was reviewed.
std::string review_list(const OpenCohort& cohort);
/// Where the cohort has a page.
void rewrite_review_list(const OpenCohort& cohort);

}  // namespace ostia::cohort
