#pragma once
/// \file Two cases of one patient compared: what changed, for a person and for scripts
/// (docs/methods/compare.md).

#include "ostia/analysis/scan_change.h"
#include "ostia/core/task_context.h"
#include "ostia/session/case_report.h"
#include "ostia/session/vessel_fat.h"

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace ostia::session {

/// One case of a comparison.
struct ComparedCase {
  analysis::ScannedTree tree;
  std::string model_digest;
  std::optional<ImageReference> image;  ///< how the case knows it
  bool has_image = false;               ///< plaque was measured in it
  std::optional<double> tube_kv;        ///< of the scan, where it is known
  std::vector<std::string> warnings;
};
/// Of a report that was made for the case, and the fat where it was measured. Lesions that a reader has
/// rejected are left out.
ComparedCase compared_case(const lumen::LumenModel& model, const CaseReport& report,
                           const CaseFat* fat = nullptr);

/// From the former scan's world to the later one's, in place of the rigid motion between the trees.
struct ScanMap {
  analysis::PointMap map;
  std::string words;  ///< what it is, for a reader
};

struct ComparisonOptions {
  analysis::ScanChangeOptions change;
  analysis::SamePatientBounds bounds;
  bool anyway = false;  ///< trees that are hardly of one patient are compared, too, and it is told
};

struct Comparison {
  ComparedCase before, after;
  analysis::TreeFit fit;
  std::string map_words;
  std::string another_patient;  ///< why the trees are hardly of one patient; empty where they may be
  analysis::Repeatability repeatability;
  analysis::ScanChange change;
  std::vector<std::string> warnings;
};
/// Throws InvalidInput for bad options, trees that share no vessel's name, and trees that are hardly of one
/// patient (unless `anyway`).
Comparison compare_cases(ComparedCase before, ComparedCase after, const ComparisonOptions& options = {},
                         const std::optional<ScanMap>& map = {});

std::string comparison_json(const Comparison& comparison);  ///< docs/schemas/comparison.schema.json
/// One line a measure of a lesion, segment, vessel, and of the patient; RFC 4180.
std::string comparison_csv(const Comparison& comparison);
/// For each vessel with 10 mm or more in both: diameter and plaque along it, before and now, by the later
/// scan's abscissas.
std::vector<KeyImage> comparison_images(const Comparison& comparison);
std::string comparison_html(const Comparison& comparison, const std::vector<KeyImage>& images);
std::string comparison_pdf(const Comparison& comparison, const std::vector<KeyImage>& images);
/// comparison.json, .csv, .html, .pdf, images/*.png and, last, manifest.json; whole or not at all. Throws
/// InvalidInput for a folder that holds other files, IoError, ResourceError, Cancelled.
void write_comparison(const std::filesystem::path& folder, const Comparison& comparison,
                      const pipeline::JobKey& job, ExitCode code, double seconds_before = 0.0,
                      const core::TaskContext& task = core::no_task());

/// A table of repeatability as comparison.json and cohort.json have it ("repeatability"), of such a file's
/// text. Throws InvalidInput that names the field.
analysis::Repeatability repeatability_of_json(const std::string& text, const std::string& file);

/// A measure in both scans of one pair of a cohort.
struct CohortRow {
  std::string pair;
  analysis::ChangeScope scope = analysis::ChangeScope::lesion;
  std::string label;
  analysis::ChangeMeasure measure = analysis::ChangeMeasure::least_area;
  analysis::Difference difference;
};
/// What was measured in both scans.
std::vector<CohortRow> cohort_rows(const std::string& pair, const Comparison& comparison);
/// What two scans differ by: root mean square of the differences by scope and measure, with a share of the
/// mean where ten values or more say that it grows with it. True of a cohort of unchanged patients alone.
analysis::Repeatability cohort_repeatability(const std::vector<CohortRow>& rows, const std::string& from);
/// Bland and Altman's statistics and repeatability by scope and measure (docs/schemas/cohort.schema.json).
std::string cohort_json(const std::vector<CohortRow>& rows, const std::vector<std::string>& warnings);
std::string cohort_csv(const std::vector<CohortRow>& rows);
/// A page with Bland and Altman's plots.
std::string cohort_html(const std::vector<CohortRow>& rows, const std::vector<std::string>& warnings);

}  // namespace ostia::session
