#pragma once
/// \file A cohort's measures against what else is known of its scans: agreement, and who has something.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/agreement.h"
#include "ostia/evaluation/roc.h"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::cohort {

struct StatisticsOptions {
  std::filesystem::path tables;     ///< that `write_measure_table` has made
  std::filesystem::path reference;  ///< CSV, a row a scan or a row a value: docs/reference/cohort.md
  std::filesystem::path output;     ///< folder that is made
};

/// A measure that both have.
struct MeasureInBoth {
  std::string level;  ///< of its items; "scan": the worst of a scan's
  std::string measure, unit;
  std::vector<std::string> scans, items;  ///< whose the pairs are
  std::vector<double> reference, result;  ///< the pairs
  evaluation::BlandAltman agreement;
};

/// A measure of a scan (its worst) against an outcome that the reference has.
struct MeasureOfOutcome {
  std::string measure, unit, outcome;
  bool low_is_worse = false;  ///< thresholds are upper ones then
  evaluation::Roc roc;        ///< of the measure, its sign changed where low is worse
};

struct Statistics {
  std::size_t scans = 0;    ///< of the tables that the reference knows
  std::size_t unknown = 0;  ///< of the reference that the tables do not have
  std::vector<MeasureInBoth> agreements;
  std::vector<MeasureOfOutcome> outcomes;
};

/// Lower values of this measure are worse: `ffr`, flows, and what begins with `least_`.
bool low_is_worse(const std::string& measure);

/// Makes the folder `output`: index.html (a page with plots), agreement.csv, roc.csv, pairs.csv and a
/// manifest. Of measures that both have, where there are two pairs at least: Bland and Altman's statistics;
/// of columns of the reference that are 0 and 1 and no measure: ROC curves of the scans' stenosis, area,
/// plaque and FFR. Throws InvalidInput: no tables, a reference that cannot be used (with the line), nothing
/// in both; `output` holds other things; IoError, ResourceError, Cancelled.
Statistics write_statistics(const StatisticsOptions& options,
                            const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
