#pragma once
/// \file How hard a suite of synthetic patients is: two classical methods whose scores on real scans are
/// published, and the search without a click, on the suites `full` and `hard` (docs/experiments/hard.md).

#include "ostia/core/task_context.h"
#include "ostia/experiments/extraction.h"
#include "ostia/phantom/hard_suite.h"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <string>
#include <vector>

namespace ostia::experiments {

/// A patient whose coronary tree a heart is built around.
struct HardPatient {
  std::string name;  ///< of the file, without folder and ending
  std::shared_ptr<const phantom::PatientTree> tree;
};
/// The masks of a folder (.nrrd, .nii, .nii.gz, .mha, .mhd) in the order of their names, 0.5 mm of rim taken
/// off. Throws InvalidInput naming the folder where it holds none, and the file that is no coronary tree;
/// IoError, Cancelled.
std::vector<HardPatient> read_hard_patients(const std::filesystem::path& folder,
                                            const core::TaskContext& task = core::no_task());

struct HardOptions {
  std::uint64_t first_seed = 1;
  int cases = 10;         ///< of each kind of heart and each suite, [1, 100]
  bool easy = false;      ///< the suite `full` as well, from the same seeds
  bool search = true;     ///< false: the two classical methods alone, as for a calibration
  double voxel_mm = 0.5;  ///< of the images, in the plane, [0.35, 2]
  phantom::HardStrength strength;
  ExtractionScoreOptions scores;
};
void validate(const HardOptions& options);  ///< throws InvalidInput

enum class HardSuite { full, hard };
const char* word(HardSuite suite);  ///< "full", "hard"

enum class HardMethod {
  path,     ///< Frangi's vesselness and the cheapest way between a vessel's true ends
  growing,  ///< threshold, region growing from the true ostia, skeleton
  search    ///< ours, without a click
};
const char* word(HardMethod method);  ///< "path", "growing", "search"

/// One case by all methods.
struct HardRun {
  HardSuite suite = HardSuite::hard;
  std::uint64_t seed = 0;
  std::string patient;                ///< HardPatient::name; empty: the heart is drawn
  phantom::HardDraw draw;             ///< of the suite hard
  ExtractionRun path, growing;        ///< axes alone
  ExtractionRun search;               ///< without vessels where it was not asked for
  std::vector<std::string> warnings;  ///< of the search
};
const ExtractionRun& run_of(const HardRun& run, HardMethod method);

/// `cases` drawn hearts and, where there are patients, as many around their trees in turn, each scanned on
/// the heart's field, in the order suite, kind of heart, seed. Vessels that are 1.5 mm wide at least where
/// they leave their parent are judged. Deterministic. Throws InvalidInput, Cancelled.
std::vector<HardRun> run_hard(const HardOptions& options, const std::vector<HardPatient>& patients = {},
                              const core::TaskContext& task = core::no_task());

/// What a method scored on the real scans of the Rotterdam challenge: means over its vessels.
struct PublishedScore {
  double ov = 0.0, of = 0.0, ot = 0.0, ai_mm = 0.0;
  std::string method;  ///< and where it is published
};
PublishedScore published(HardMethod method);

/// A suite's cases of one kind of heart together, by one method.
struct HardRow {
  HardSuite suite = HardSuite::hard;
  bool patients = false;
  HardMethod method = HardMethod::path;
  std::size_t cases = 0, refused = 0;
  ExtractionSummary summary;
};
/// Suite by suite, drawn hearts first, in the methods' order; what has no case, or was not run, is left out.
std::vector<HardRow> rows_of(const std::vector<HardRun>& runs, const ExtractionScoreOptions& options);

/// What decides whether the experiment was done already.
std::string parameters_json(const HardOptions& options);
/// docs/schemas/experiment-hard.schema.json.
std::string hard_json(const std::vector<HardRun>& runs, const HardOptions& options);
/// The table in plain text.
std::string hard_text(const std::vector<HardRun>& runs, const HardOptions& options);
/// Into an existing folder: cases.csv, vessels.csv, report.html.
void write_hard_report(const std::filesystem::path& folder, const std::vector<HardRun>& runs,
                       const HardOptions& options);

}  // namespace ostia::experiments
