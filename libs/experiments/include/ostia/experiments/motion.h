#pragma once
/// \file The motion experiment: a coronary tree's template brought onto all phases of hearts whose motion is
/// known, by depth of the cage, by method, and by how many phases are known ([Yi] 5: table 1, figures 6, 7,
/// 9); stretch and torsion of the fitted motion's branches.

#include "ostia/core/task_context.h"
#include "ostia/experiments/beating_heart.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

enum class MotionMethod {
  none,          ///< the template as it is: "before registration"
  cage,          ///< motion::register_cage, each phase from its neighbour's
  cage_rest,     ///< the same from rest, as all that follow
  descent,       ///< the paper's gradient descent
  descent_free,  ///< the same without the hyperelastic energy
  tps_l2,
  tps_kc,
  grbf_l2,
  grbf_kc
};
const char* word(MotionMethod method);  ///< "cage", "tps-l2", ...
/// Throws InvalidInput for a word that is none.
MotionMethod motion_method_of(const std::string& word);

struct MotionOptions {
  int hearts = 8;  ///< [1, 100]; seeds from heart.seed on
  BeatingHeartOptions heart;
  std::vector<int> depths{1, 2, 3, 4, 5};  ///< of the cage, each on all phases
  int depth = 4;                           ///< of all that is compared otherwise; one of `depths`
  /// Compared at these phases (shares of the cycle) of the first `compared_hearts` hearts.
  std::vector<MotionMethod> methods{
      MotionMethod::cage_rest, MotionMethod::descent, MotionMethod::descent_free, MotionMethod::tps_l2,
      MotionMethod::tps_kc,    MotionMethod::grbf_l2, MotionMethod::grbf_kc};
  std::vector<double> compared_phases{0.15, 0.25, 0.35, 0.5};
  int compared_hearts = 2;
  double dice_resolution_mm = 0.1;  ///< evaluation::compare_enclosed
  /// What is finished is kept here, run by run, and what is here is not done again; empty: nowhere.
  std::filesystem::path keep;
};
void validate(const MotionOptions& options);  ///< throws InvalidInput

/// One phase of one heart.
struct MotionRun {
  std::string heart;
  double phase = 0.0;
  MotionMethod method = MotionMethod::none;
  int depth = 0;         ///< 0: none
  std::string sampling;  ///< phases that were known: "all", "odd 10", "even 10", "odd 5", "even 5" of 20
  std::string lost;      ///< branch that the target lacks
  double seconds = 0.0;  ///< of the registration; wall clock
  double processor_seconds = 0.0;  ///< the same, of all threads
  double distance_mm = 0.0;        ///< mean from the target's points to the result, as in [Yi] 5.1
  double dice = 0.0;               ///< of what result and true tree enclose
  double vertex_mm = 0.0, vertex_worst_mm = 0.0;  ///< to where the known motion carries the points
  std::size_t inverted_cells = 0;                 ///< least Bernstein coefficient of the Jacobian not above 0
  std::size_t new_intersections = 0;              ///< pairs of triangles beyond the template's own
};

/// A branch at one phase, from the cage of MotionOptions::depth and from the known motion
/// (analysis::measure_motion; means over the branch's length, NaN where they cannot be measured).
struct BranchRun {
  std::string heart;
  double phase = 0.0;
  int depth = 0;  ///< of the cage
  std::string branch;
  double length_mm = 0.0;                        ///< at the template
  double stretch = 0.0, true_stretch = 0.0;      ///< length over that at the template
  double torsion = 0.0, true_torsion = 0.0;      ///< of the axis, 1/mm
  double template_torsion = 0.0;                 ///< 1/mm
  double size = 0.0, true_size = 0.0;            ///< of the torsion (MotionMeasure::torsion_size), 1/mm
  double template_size = 0.0;                    ///< 1/mm
  double curvature = 0.0, true_curvature = 0.0;  ///< 1/mm
  double template_curvature = 0.0;
};

struct MotionResults {
  std::vector<MotionRun> runs;
  std::vector<BranchRun> branches;
};

/// Heart by heart; where there is a folder to keep runs in, all that it holds. All but seconds is
/// deterministic. Throws InvalidInput (options; kept runs of other hearts), IoError, Cancelled.
MotionResults run_motion(const MotionOptions& options, const core::TaskContext& task = core::no_task());

/// Runs of one method, depth and sampling together.
struct MotionRow {
  MotionMethod method = MotionMethod::none;
  int depth = 0;
  std::string sampling;
  std::size_t runs = 0;
  double seconds = 0.0, processor_seconds = 0.0;
  double distance_mm = 0.0, distance_sd_mm = 0.0, dice = 0.0, dice_sd = 0.0;  ///< means
  double least_dice = 0.0, vertex_mm = 0.0, worst_vertex_mm = 0.0;            ///< the worst mean of a run
  std::size_t inverted_cells = 0, new_intersections = 0;                      ///< sums
};
/// By method, depth and sampling. `compared`: only phases and hearts at which every method was run that was
/// run at all, and only all phases known.
std::vector<MotionRow> rows_of(const std::vector<MotionRun>& runs, bool compared);

/// How near a measure of fitted motions is to the known ones, over branches and phases.
struct BranchAgreement {
  std::size_t count = 0;
  double median = 0.0, p95 = 0.0, worst = 0.0;  ///< |fitted - true| / |true|
  double within_5_percent = 0.0;                ///< share of them
  double of_change = 0.0;  ///< mean |fitted - true| over the branch's largest true change from the template
};
/// Torsion and its size are compared where the true one is at least 0.005/mm: the rest bends in a plane.
struct BranchAgreements {
  BranchAgreement stretch, torsion, torsion_size, curvature;
};
BranchAgreements agreement(const std::vector<BranchRun>& branches);

std::string parameters_json(const MotionOptions& options);
std::string motion_json(const MotionResults& results, const MotionOptions& options);
std::string motion_text(const MotionResults& results);
/// Into an existing folder: runs.csv, branches.csv, report.html and pictures: Dice and distance by phase for
/// depths, methods and samplings, and heart by heart; stretch and torsion, fitted and known.
void write_motion_report(const std::filesystem::path& folder, const MotionResults& results,
                         const MotionOptions& options);

}  // namespace ostia::experiments
