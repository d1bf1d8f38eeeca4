#include "ostia/experiments/certainty.h"

#include "extraction/own_axes.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/polyline.h"
#include "ostia/imaging/image_file.h"
#include "ostia/phantom/noise.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace ostia::experiments {
namespace {

using core::rounded_text;
using geometry::Vec3;

constexpr double right_share = 0.8;

/// One of several, as likely as they stand there.
template <class T, std::size_t n>
T one_of(const std::array<T, n>& choices, double chance) {
  return choices[std::min(static_cast<std::size_t>(chance * static_cast<double>(n)), n - 1)];
}

coronary::ExtractOptions options_of(SearchKind search) {
  coronary::ExtractOptions options;
  if (search == SearchKind::loose) options.growth.least_tube *= 0.5;
  return options;
}

/// The share of an axis, between two abscissas of the whole vessel, that lies within a true lumen.
double share_within(const std::vector<OwnAxis>& truth, const OwnAxis& axis, double from_mm, double to_mm) {
  constexpr double step_mm = 0.25;
  const double own_mm = geometry::length(axis.points);
  const double from = std::clamp(from_mm - axis.from_mm, 0.0, own_mm),
               to = std::min(to_mm - axis.from_mm, own_mm);
  const int steps = std::max(1, static_cast<int>(std::lround((to - from) / step_mm)));
  int within = 0;
  for (int i = 0; i < steps; ++i) {
    const double s = from + (to - from) * (i + 0.5) / steps;
    const NearestAxis near = nearest_axis(truth, geometry::at_abscissa(axis.points, s).point);
    within += near.away_mm <= near.radius_mm ? 1 : 0;
  }
  return static_cast<double>(within) / steps;
}

void search_and_judge(const imaging::ImageVolume& image, const ExtractionTruth& truth, SearchKind search,
                      CertaintyRuns& runs, const core::TaskContext& task) {
  ++runs.searches;
  try {
    judge(coronary::extract(image, options_of(search), task), truth, search, runs);
  } catch (const GeometryError&) {
    ++runs.refused;
  } catch (const InvalidInput&) {  // what the search refuses to look at
    ++runs.refused;
  }
}

}  // namespace

bool JudgedPiece::right() const {
  return within >= right_share;
}

std::string name_of(SearchKind search) {
  return search == SearchKind::usual ? "usual" : "loose";
}

void validate(const CertaintyOptions& options) {
  const auto require = [](bool fine, const std::string& what) {
    if (!fine) throw InvalidInput("certainty experiment: " + what);
  };
  require(options.patients >= 1 && options.patients <= 500,
          "1 to 500 patients, not " + std::to_string(options.patients));
  require(options.scans >= 1 && options.scans <= 20,
          "1 to 20 scans of a patient, not " + std::to_string(options.scans));
  require(options.voxel_mm >= 0.5 && options.voxel_mm <= 2.0,
          "voxels of 0.5 to 2 mm, not " + std::to_string(options.voxel_mm));
}

std::vector<Variation> drawn_variations(std::uint64_t seed, int scans) {
  constexpr std::uint64_t of_draws = 0x9e3779b97f4a7c15U;  // apart from what else is drawn from the seed
  constexpr std::uint64_t most_draws = 16;
  using phantom::Anatomy;
  std::vector<Variation> all;
  for (int scan = 0; scan < scans; ++scan) {
    std::uint64_t index = static_cast<std::uint64_t>(scan) * most_draws;
    const auto chance = [&] { return phantom::uniform(seed ^ of_draws, index++); };
    Variation one;
    one.motion_mm = one_of(std::array{0.0, 0.0, 1.0, 2.0, 3.0}, chance());
    one.slice_mm = one_of(std::array{0.9, 0.9, 1.5, 2.0}, chance());
    one.patient.contrast_hu = std::round(200.0 + 350.0 * chance());
    one.patient.calcium = one_of(std::array{0.0, 1.0, 1.0, 4.0, 10.0}, chance());
    one.patient.venous = one_of(std::array{0.0, 0.0, 0.5, 1.0}, chance());
    one.patient.anatomy = one_of(
        std::array{Anatomy::usual, Anatomy::usual, Anatomy::usual, Anatomy::usual, Anatomy::rca_from_left,
                   Anatomy::lcx_from_right, Anatomy::bypass, Anatomy::left_ostium_closed},
        chance());
    one.what = rounded_text(one.motion_mm, 0) + " mm of motion, slices of " + rounded_text(one.slice_mm, 1) +
               " mm, contrast " + rounded_text(*one.patient.contrast_hu, 0) + " HU, calcium " +
               rounded_text(one.patient.calcium, 0) + ", veins " +
               rounded_text(100.0 * one.patient.venous, 0) + " %, " + phantom::word(one.patient.anatomy);
    // The same clean image serves all its levels of noise.
    for (const double usual : {20.0, 40.0, 60.0, 85.0}) {
      one.noise_hu = std::round(usual * (0.85 + 0.3 * chance()));
      one.step = rounded_text(one.noise_hu, 0) + " HU of noise";
      all.push_back(one);
    }
  }
  return all;
}

void judge(const coronary::Extraction& found, const ExtractionTruth& truth, SearchKind search,
           CertaintyRuns& runs) {
  const std::vector<OwnAxis> true_axes = own_axes(truth.tree);
  for (const OwnAxis& axis : own_axes(found.vessels.tree)) {
    const auto known =
        std::find_if(found.certainty.begin(), found.certainty.end(),
                     [&](const coronary::VesselCertainty& one) { return one.vessel == axis.vessel; });
    if (known == found.certainty.end() || known->pieces.empty()) continue;
    const auto judged = [&](double from_mm, double to_mm, const auto& looks, double probability) {
      return JudgedPiece{truth.case_name, axis.name,
                         search,          from_mm,
                         to_mm,           {looks.begin(), looks.end()},
                         probability,     share_within(true_axes, axis, from_mm, to_mm)};
    };
    runs.first_piece.push_back(runs.pieces.size());
    for (const coronary::VesselPiece& piece : known->pieces)
      runs.pieces.push_back(judged(piece.from_mm, piece.to_mm, piece.looks, piece.probability));
    runs.vessels.push_back(
        judged(known->pieces.front().from_mm, known->pieces.back().to_mm, known->looks, known->probability));
  }
}

CertaintyRuns judge_certainty(const CertaintyOptions& options, const core::TaskContext& task) {
  validate(options);
  CertaintyRuns runs;
  for (int patient = 0; patient < options.patients; ++patient) {
    RobustnessOptions one;
    one.first_seed = options.first_seed + static_cast<std::uint64_t>(patient);
    one.seeds = 1;
    one.voxel_mm = options.voxel_mm;
    const double count = options.patients;
    scan_patients(
        drawn_variations(one.first_seed, options.scans), one,
        [&](const VariedScan& scan, const core::TaskContext& part) {
          ExtractionTruth truth = scan.truth;
          truth.case_name = "seed " + std::to_string(scan.seed) + ", " + truth.case_name;
          search_and_judge(scan.image, truth, SearchKind::usual, runs, part.sub(0.0, 0.5));
          search_and_judge(scan.image, truth, SearchKind::loose, runs, part.sub(0.5, 1.0));
        },
        task.sub(patient / count, (patient + 1) / count));
  }
  return runs;
}

CertaintyRuns judge_certainty_of_suite(const std::filesystem::path& suite, const core::TaskContext& task) {
  const std::vector<std::filesystem::path> cases = cases_of_suite(suite);
  for (const std::filesystem::path& one : cases) image_of_case(one);  // before hours of work
  CertaintyRuns runs;
  const double count = static_cast<double>(cases.size());
  for (std::size_t i = 0; i < cases.size(); ++i) {
    const core::TaskContext part =
        task.sub(static_cast<double>(i) / count, static_cast<double>(i + 1) / count);
    part.throw_if_cancelled();
    const ExtractionTruth truth = read_extraction_truth(cases[i]);
    const imaging::ImageVolume image = imaging::read_image(image_of_case(cases[i])).volume;
    search_and_judge(image, truth, SearchKind::usual, runs, part);
  }
  return runs;
}

std::vector<evaluation::Forecast> forecasts_of(const std::vector<JudgedPiece>& pieces) {
  std::vector<evaluation::Forecast> forecasts;
  for (const JudgedPiece& one : pieces) forecasts.push_back({one.probability, one.right()});
  return forecasts;
}

}  // namespace ostia::experiments
