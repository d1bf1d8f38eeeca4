#pragma once
/// \file The measures of a whole cohort as tidy tables.

#include "ostia/core/task_context.h"

#include <cstddef>
#include <filesystem>

namespace ostia::cohort {

struct MeasureTableResult {
  std::size_t scans = 0;     ///< of the cohort
  std::size_t measured = 0;  ///< whose measures are done
  std::size_t values = 0;    ///< rows of measures.csv
};

/// Makes the folder `output`: `scans.csv` (a row a scan: how far it is), `measures.csv` (a row a value),
/// `dictionary.csv` (what each column and measure is, with its unit), all three as tables of
/// `measures.sqlite`, and a manifest. Only results that `read_status` would count as done are taken. Throws
/// InvalidInput (no cohort; a folder that holds other things), IoError, ResourceError, Cancelled.
MeasureTableResult write_measure_table(const std::filesystem::path& cohort,
                                       const std::filesystem::path& output,
                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::cohort
