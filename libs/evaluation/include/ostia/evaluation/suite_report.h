#pragma once
/// \file The comparison of two runs as an HTML page with pictures and plots.

#include "ostia/evaluation/suite.h"

#include <cstddef>

namespace ostia::evaluation {

struct SuiteReportOptions {
  std::size_t most_plots = 24;     ///< plots of figures; those with findings come first
  std::size_t most_pictures = 12;  ///< files shown as pictures; those farthest off come first
  std::size_t most_rows = 400;     ///< rows of the table of findings; what is left out is counted
};

/// Writes `page` (.html, everything in it): verdict, counts, findings; each figure golden against result,
/// case by case; surfaces coloured by their signed distance from the golden ones; lines and slices where they
/// differ. Reads both trees again for the pictures. Whole or not at all.
void write_suite_report(const std::filesystem::path& page, const SuiteResult& suite,
                        const std::filesystem::path& golden, const std::filesystem::path& result,
                        const SuiteReportOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
