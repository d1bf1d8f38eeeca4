#pragma once
/// \file The motion experiment: a coronary tree's template brought onto all phases of hearts whose motion is
/// known, by depth of the cage, by method, and by how many phases are known ([Yi] 5: table 1, figures 6, 7,
/// 9).

#include "ostia/core/task_context.h"
#include "ostia/experiments/beating_heart.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::experiments {

enum class MotionMethod {
  none,          ///< the template as it is: "before registration"
  cage,          ///< motion::register_cage
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
  std::vector<MotionMethod> methods{MotionMethod::descent, MotionMethod::descent_free, MotionMethod::tps_l2,
                                    MotionMethod::tps_kc,  MotionMethod::grbf_l2,      MotionMethod::grbf_kc};
  std::vector<double> compared_phases{0.15, 0.25, 0.35, 0.5};
  int compared_hearts = 2;
  double dice_resolution_mm = 0.1;  ///< evaluation::compare_enclosed
};
void validate(const MotionOptions& options);  ///< throws InvalidInput

/// One phase of one heart.
struct MotionRun {
  std::string heart;
  double phase = 0.0;
  MotionMethod method = MotionMethod::none;
  int depth = 0;             ///< 0: none
  std::string sampling;      ///< phases that were known: "all", "odd 10", "even 10", "odd 5", "even 5" of 20
  std::string lost;          ///< branch that the target lacks
  double seconds = 0.0;      ///< of the registration; wall clock
  double distance_mm = 0.0;  ///< mean from the target's points to the result, as in [Yi] 5.1
  double dice = 0.0;         ///< of what result and true tree enclose
  double vertex_mm = 0.0, vertex_worst_mm = 0.0;  ///< to where the known motion carries the points
  std::size_t inverted_cells = 0;                 ///< least Bernstein coefficient of the Jacobian not above 0
  std::size_t new_intersections = 0;              ///< pairs of triangles beyond the template's own
};

/// Heart by heart. All but `seconds` is deterministic. Throws InvalidInput, Cancelled.
std::vector<MotionRun> run_motion(const MotionOptions& options,
                                  const core::TaskContext& task = core::no_task());

/// Runs of one method, depth and sampling together.
struct MotionRow {
  MotionMethod method = MotionMethod::none;
  int depth = 0;
  std::string sampling;
  std::size_t runs = 0;
  double seconds = 0.0, distance_mm = 0.0, distance_sd_mm = 0.0, dice = 0.0, dice_sd = 0.0;  ///< means
  double least_dice = 0.0, vertex_mm = 0.0, worst_vertex_mm = 0.0;  ///< the worst mean of a run
  std::size_t inverted_cells = 0, new_intersections = 0;            ///< sums
};
/// In the order in which they appear. `compared`: only phases and hearts at which all methods were run.
std::vector<MotionRow> rows_of(const std::vector<MotionRun>& runs, bool compared);

std::string parameters_json(const MotionOptions& options);
std::string motion_json(const std::vector<MotionRun>& runs, const MotionOptions& options);
std::string motion_text(const std::vector<MotionRun>& runs);
/// Into an existing folder: runs.csv, report.html and pictures: Dice and distance by phase for depths,
/// methods and samplings, and heart by heart.
void write_motion_report(const std::filesystem::path& folder, const std::vector<MotionRun>& runs,
                         const MotionOptions& options);

}  // namespace ostia::experiments
