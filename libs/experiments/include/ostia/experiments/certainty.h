#pragma once
/// \file The certainty experiment: whether the probabilities of found vessels, and of their centimetres, are
/// the shares that are right, in patients of many difficulties; and the weights that make them so.

#include "ostia/core/task_context.h"
#include "ostia/coronary/extract.h"
#include "ostia/evaluation/calibration.h"
#include "ostia/experiments/robustness.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <utility>
#include <vector>

namespace ostia::experiments {

struct CertaintyOptions {
  std::uint64_t first_seed = 1;
  int patients = 4;       ///< with the seeds from the first on, [1, 500]
  int scans = 2;          ///< of each patient, drawn from its seed, each with four levels of noise, [1, 20]
  double voxel_mm = 0.7;  ///< in the plane, [0.5, 2]
};
void validate(const CertaintyOptions& options);  ///< throws InvalidInput

/// The scans of a patient: motion, slices, contrast, calcium, veins, origins and noise by chance.
std::vector<Variation> drawn_variations(std::uint64_t seed, int scans);

/// How what is judged was found.
enum class SearchKind {
  usual,  ///< by coronary::extract as it is
  loose,  ///< with half of the likeness to a tube: branches that are none come through
};
std::string name_of(SearchKind search);

/// A vessel's own part, or a centimetre of it, with what was said of it and what is true.
struct JudgedPiece {
  std::string scan;  ///< "seed 3, 60 HU of noise, ..."
  std::string vessel;
  SearchKind search = SearchKind::usual;
  double from_mm = 0.0, to_mm = 0.0;  ///< on the vessel's axis
  std::vector<double> looks;          ///< coronary::piece_looks or vessel_looks
  double probability = 0.0;
  double within = 0.0;  ///< share of its length that lies within a true vessel's lumen
  /// Four fifths of it or more.
  bool right() const;
};

struct CertaintyRuns {
  std::vector<JudgedPiece> pieces, vessels;  ///< each vessel's pieces one after the other
  std::vector<std::size_t> first_piece;      ///< one a vessel: where its pieces begin
  std::size_t searches = 0, refused = 0;
};

/// What is found in one image, judged. The truth's tree has the true lumen's radii.
void judge(const coronary::Extraction& found, const ExtractionTruth& truth, SearchKind search,
           CertaintyRuns& runs);
/// Patients drawn, scanned and searched both ways. Deterministic. Throws InvalidInput, Cancelled.
CertaintyRuns judge_certainty(const CertaintyOptions& options = {},
                              const core::TaskContext& task = core::no_task());
/// Every case of a suite, as extract_suite has it, searched as usual. Throws as it does.
CertaintyRuns judge_certainty_of_suite(const std::filesystem::path& suite,
                                       const core::TaskContext& task = core::no_task());

std::vector<evaluation::Forecast> forecasts_of(const std::vector<JudgedPiece>& pieces);

/// Of a logistic model: P = 1 / (1 + exp(-(constant + weights . looks))).
struct LogisticWeights {
  double constant = 0.0;
  std::vector<double> weights;
};
/// Maximum likelihood by Newton's method, with a small penalty on the weights of looks brought to deviation
/// 1, so that it exists where one look alone decides. Throws InvalidInput without both outcomes, or for looks
/// of different lengths.
LogisticWeights fitted_logistic(const std::vector<std::vector<double>>& looks,
                                const std::vector<bool>& right);
/// Fitted to the pieces, then to the vessels that these make.
struct CertaintyWeights {
  LogisticWeights piece, vessel;
};
CertaintyWeights fitted_weights(const CertaintyRuns& runs);  ///< throws InvalidInput where nothing differs
/// The source file that coronary::certainty_of takes them from.
std::string source_of(const CertaintyWeights& weights);

/// What decides whether the experiment was done already.
std::string parameters_json(const CertaintyOptions& options);
/// docs/schemas/experiment-certainty.schema.json.
std::string certainty_json(const CertaintyRuns& runs);
/// The figures in plain text.
std::string certainty_text(const CertaintyRuns& runs);
/// Into an existing folder: reliability.png, pieces.csv, vessels.csv and, where they can be fitted, the
/// weights of these patients as certainty_weights.h.
void write_certainty_report(const std::filesystem::path& folder, const CertaintyRuns& runs);

}  // namespace ostia::experiments
