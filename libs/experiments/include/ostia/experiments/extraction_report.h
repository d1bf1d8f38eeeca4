#pragma once
/// \file What the extraction experiment leaves behind.

#include "ostia/experiments/extraction.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

/// What decides whether the experiment was done already.
std::string parameters_json(const ExtractionScoreOptions& options);

/// The figures of a run as JSON: summary, cases, vessels, sections, stenoses.
std::string extraction_json(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options);

/// A line a case and one for all, for the terminal and the documentation.
std::string extraction_text(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options);

/// Into an existing folder: cases.csv, vessels.csv, sections.csv, stenoses.csv, report.html, diameters.png
/// (agreement of the sections' diameters).
void write_extraction_report(const std::filesystem::path& folder, const std::vector<ExtractionRun>& runs,
                             const ExtractionScoreOptions& options);

}  // namespace ostia::experiments
