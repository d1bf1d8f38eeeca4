#pragma once
/// \file The same scans in two cohorts, as two versions of the program worked on them: what changed for whom.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::cohort {

/// Of one figure over all scans that have it in both cohorts; differences are the later less the earlier.
struct MeasureAgreement {
  std::string measure, unit;
  std::size_t scans = 0, changed = 0;
  std::size_t lost = 0, gained = 0;           ///< known in the earlier alone, in the later alone
  double bias = 0.0, sd = 0.0;                ///< Bland and Altman; sd 0 for fewer than two scans
  double lower_limit = 0.0, upper_limit = 0;  ///< bias -/+ 1.96 sd
  double greatest = 0.0;                      ///< difference of the greatest amount
};

/// A stage's states where they differ.
struct StateChange {
  std::string stage, before, after;
  std::size_t scans = 0;
};

struct CohortComparison {
  std::size_t before = 0, after = 0;  ///< scans of each
  std::size_t matched = 0;            ///< imported in both from the same content
  std::size_t ambiguous = 0;          ///< of the later, whose content several scans of a cohort have
  std::size_t changed = 0;            ///< matched scans that differ in a figure or a state
  std::vector<MeasureAgreement> measures;
  std::vector<StateChange> states;
};

/// Makes the folder `output`: index.html (for a browser, without scripts), changes.csv (a row a value that
/// changed), pictures of the ten scans that changed most, and a manifest. Two cohorts have two keys, so that
/// scans are known by the digest of what was imported, and named by both pseudonyms. Memory grows by some
/// hundred bytes a scan of the earlier one. Throws as `read_status` of either, InvalidInput where one folder
/// is both or `output` holds other things, ResourceError.
CohortComparison compare_cohorts(const std::filesystem::path& before, const std::filesystem::path& after,
                                 const std::filesystem::path& output,
                                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
