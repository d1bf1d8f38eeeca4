#pragma once
/// \file The robustness experiment: one thing at a time is made worse in a synthetic patient until the tree
/// that is found without a click is no longer right.

#include "ostia/core/task_context.h"
#include "ostia/experiments/extraction.h"
#include "ostia/phantom/phantom_case.h"

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace ostia::experiments {

/// One step of one variation.
struct Variation {
  std::string what, step;        ///< "noise", "60 HU"
  phantom::CaseVariant patient;  ///< what differs in the patient
  double noise_hu = 25.0;
  double motion_mm = 0.0;
  double slice_mm = 0.9;
  double kept = 1.0;  ///< of the image's height, from the top (with the root), (0, 1]
};
/// What docs/experiments/robustness.md lists; the first one is the patient as drawn.
std::vector<Variation> usual_variations();

struct RobustnessOptions {
  std::uint64_t first_seed = 1;
  int seeds = 2;          ///< patients, [1, 20]
  double voxel_mm = 0.7;  ///< in the plane, [0.5, 2]
  ExtractionScoreOptions scores;
};
void validate(const RobustnessOptions& options);  ///< throws InvalidInput

/// A patient as one step shows it, and what is true of it (its vessels as far as they lie in the image).
struct VariedScan {
  const Variation& variation;
  std::uint64_t seed = 0;
  const imaging::ImageVolume& image;
  const ExtractionTruth& truth;
};
/// Each variation with each patient, patient by patient; `look` with a task for its own part. The field is
/// the heart's, 15 mm about tree and root. Deterministic. Throws InvalidInput, Cancelled, what `look` throws.
void scan_patients(const std::vector<Variation>& variations, const RobustnessOptions& options,
                   const std::function<void(const VariedScan&, const core::TaskContext&)>& look,
                   const core::TaskContext& task = core::no_task());

/// One patient with one step.
struct RobustnessRun {
  Variation variation;
  std::uint64_t seed = 0;
  ExtractionRun score;                ///< without wall and stenoses; `failure`: what the refusal says
  std::vector<std::string> warnings;  ///< that the search gave
};
/// Scanned as scan_patients does, and searched. Deterministic. Throws InvalidInput, Cancelled.
std::vector<RobustnessRun> vary_patients(const std::vector<Variation>& variations,
                                         const RobustnessOptions& options = {},
                                         const core::TaskContext& task = core::no_task());

/// The patients of one step together.
struct RobustnessRow {
  std::string what, step;
  std::size_t patients = 0, refused = 0;
  double ov = 0.0, ai_mm = 0.0;  ///< over all true vessels; AI over those that were found
  double main_ov = 0.0;          ///< of LAD, LCX and RCA
  std::size_t right = 0, wrong = 0, unnamed = 0, missing = 0;
  double astray_mm = 0.0;         ///< a patient
  std::vector<std::string> told;  ///< warnings of kinds that the patients as drawn had not; refusals
  bool holds() const;             ///< tree and names can be used as they are
};
/// In the order of the variations.
std::vector<RobustnessRow> rows_of(const std::vector<RobustnessRun>& runs);

/// What decides whether the experiment was done already.
std::string parameters_json(const std::vector<Variation>& variations, const RobustnessOptions& options);
/// The table as JSON.
std::string robustness_json(const std::vector<RobustnessRun>& runs, const RobustnessOptions& options);
/// The table in plain text.
std::string robustness_text(const std::vector<RobustnessRun>& runs);
/// Into an existing folder: runs.csv, report.html and, where something got worse step by step, overlap.png.
void write_robustness_report(const std::filesystem::path& folder, const std::vector<RobustnessRun>& runs);

}  // namespace ostia::experiments
