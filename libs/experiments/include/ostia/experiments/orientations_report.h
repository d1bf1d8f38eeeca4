#pragma once
/// \file What the orientations experiment leaves behind.

#include "ostia/experiments/orientations.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

/// What decides whether the experiment was done already.
std::string parameters_json(const OrientationsOptions& options, std::size_t orientations);

/// The figures as JSON (docs/schemas/experiment-orientations.schema.json): summary, tubes, orientations,
/// measures.
std::string orientations_json(const std::vector<OrientationRun>& runs, const OrientationsOptions& options);

/// A table for the terminal.
std::string orientations_text(const std::vector<OrientationRun>& runs);

/// Into an existing folder: measures.csv, report.html, length.png and radius.png (Bland and Altman's plots
/// against the tubes' means and against the truth).
void write_orientations_report(const std::filesystem::path& folder, const std::vector<OrientationRun>& runs,
                               const OrientationsOptions& options);

}  // namespace ostia::experiments
