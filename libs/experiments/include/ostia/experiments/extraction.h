#pragma once
/// \file The extraction experiment: how near the tree and the lumen that are found without a click come to
/// the truth of a suite.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/centerline_scores.h"
#include "ostia/evaluation/lumen_scores.h"
#include "ostia/evaluation/stenosis_detection.h"
#include "ostia/geometry/contour_set.h"
#include "ostia/session/found_model.h"

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ostia::experiments {

/// A vessel that is there, from its ostium to its end.
struct TrueVessel {
  std::string name;
  bool annotated = false;  ///< one of the challenge's four; its reference is theirs
  io::RotterdamReference reference;
};

/// What is known of a case.
struct ExtractionTruth {
  std::string case_name;
  geometry::VesselTree tree;  ///< radii: the lumen's
  std::vector<TrueVessel> vessels;
  geometry::ContourSet contours;            ///< observer "truth", boundary "lumen" are asked
  std::vector<evaluation::Lesion> lesions;  ///< by vessel; abscissas from where it leaves its parent's axis
};
/// From a folder as `ostia phantom` writes it: case.json, centerlines.vtp, contours.json and
/// vesselM/reference.txt. Throws InvalidInput naming what is missing, IoError.
ExtractionTruth read_extraction_truth(const std::filesystem::path& folder);

/// A suite's folders dataset*, by name. Throws InvalidInput where there is none.
std::vector<std::filesystem::path> cases_of_suite(const std::filesystem::path& suite);
/// image*.nrrd or image*.mhd of a case's folder, the first by name. Throws InvalidInput where there is none.
std::filesystem::path image_of_case(const std::filesystem::path& folder);

struct ExtractionScoreOptions {
  /// A found axis that lies farther outside of every true lumen follows something else, mm, > 0.
  double astray_mm = 1.0;
  double threshold = 0.5;  ///< diameter stenosis to be found, (0, 1)
};
void validate(const ExtractionScoreOptions& options);  ///< throws InvalidInput

enum class NameVerdict { right, wrong, unnamed, missing };
std::string name_of(NameVerdict verdict);

/// How a true vessel was found.
struct VesselRun {
  std::string name;
  bool annotated = false;
  double length_mm = 0.0;
  evaluation::CenterlineScores scores;               ///< without the pairs; OV 0 where no line overlaps
  std::vector<std::pair<double, double>> missed_mm;  ///< stretches of the reference, from the ostium
  /// Of the found vessel that covers most of its own stretch, if it covers half of it.
  std::string found_name;
  NameVerdict verdict = NameVerdict::missing;
};

struct ExtractionRun {
  std::string case_name;
  std::string failure;  ///< why nothing was found; everything then counts as missed
  std::vector<VesselRun> vessels;
  double found_mm = 0.0;                            ///< length of the found tree
  double astray_mm = 0.0, longest_astray_mm = 0.0;  ///< of it what follows no artery; in one piece
  std::vector<evaluation::SectionScore> sections;
  std::vector<evaluation::Lesion> lesions, found_lesions;  ///< of any grade
  double seconds = 0.0, peak_mb = 0.0;  ///< of finding alone; peak: of the process up to then
};

/// Axes by the challenge's measures and names alone, without wall and stenoses. Deterministic. Throws as
/// evaluation does, Cancelled.
ExtractionRun score_axes(const ExtractionTruth& truth, const coronary::LabelledTree& found,
                         const ExtractionScoreOptions& options = {},
                         const core::TaskContext& task = core::no_task());
/// Axes by the challenge's measures (the best line for each vessel), names, sections on the model's solved
/// wall, stenoses as the case report has them. Deterministic. Throws as evaluation does, Cancelled.
ExtractionRun score_extraction(const ExtractionTruth& truth, const session::FoundModel& found,
                               const ExtractionScoreOptions& options = {},
                               const core::TaskContext& task = core::no_task());
/// The same where nothing was found.
ExtractionRun score_of_no_extraction(const ExtractionTruth& truth, const std::string& why);

/// Finds and scores every case of a suite: folders dataset*, each with an image
/// (image_of_case) and its truth, one after the other. Throws InvalidInput where there is none, naming what
/// is missing.
std::vector<ExtractionRun> extract_suite(const std::filesystem::path& suite,
                                         const ExtractionScoreOptions& options = {},
                                         const core::TaskContext& task = core::no_task());

/// Of any number of cases.
struct ExtractionSummary {
  evaluation::MeanCenterlineScores annotated, all;  ///< vessels of the same weight
  std::size_t right = 0, wrong = 0, unnamed = 0, missing = 0;
  double found_mm = 0.0, astray_mm = 0.0;
  evaluation::LumenSummary healthy, diseased;
  evaluation::LesionDetection stenoses;
  double most_seconds = 0.0, most_mb = 0.0;
};
ExtractionSummary summarize(const std::vector<ExtractionRun>& runs, const ExtractionScoreOptions& options);

}  // namespace ostia::experiments
