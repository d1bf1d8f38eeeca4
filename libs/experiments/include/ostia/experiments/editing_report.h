#pragma once
/// \file What the editing experiment leaves behind.

#include "ostia/experiments/editing.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

/// What decides whether the experiment was done already.
std::string parameters_json(const EditingOptions& options);

/// The figures of a run as JSON (docs/schemas/experiment-editing.schema.json): summary by health, sections,
/// steps.
std::string editing_json(const std::vector<SectionRun>& runs, const EditingOptions& options);

/// Into an existing folder: sections.csv, steps.csv, report.html, accuracy.png (accuracy
/// over strokes and over modelled time, all sections), one-section.png (a diseased one, as figure 3 of
/// [Wels]), and in edits/ for each section CASE_SECTION.ostia and .jsonl, which `ostia replay` runs.
void write_editing_report(const std::filesystem::path& folder, const std::vector<SectionRun>& runs,
                          const EditingOptions& options);

/// Mean MSD over sections after each stroke (a section that is finished keeps its last value): [stroke].
std::vector<double> accuracy_over_strokes(const std::vector<SectionRun>& runs, geometry::Health health);

}  // namespace ostia::experiments
