#pragma once
/// \file The pressure experiment: pressure along vessels in one dimension (`hemodynamics`) against three
/// (OpenFOAM). See docs/experiments/pressure.md.

#include "ostia/experiments/pressure_plan.h"
#include "ostia/experiments/pressure_run.h"
#include "ostia/hemodynamics/flow_model.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::experiments {

struct PressureOptions {
  PressurePlanOptions plan;
  PressureMesh mesh;
  /// Of the mesh's edges, for three cases: one run each. Empty: none.
  std::vector<double> other_edge_ratios{0.31, 0.155};
  /// Folder that keeps each run as it is finished (CASE.json): what is in it is not run again.
  std::filesystem::path keep;
  std::filesystem::path masks;  ///< folder; empty: no patients
  std::vector<std::string> patients{"patient001", "patient010",
                                    "patient171"};  ///< files in it, without .nrrd
  /// Names, kinds or halves to be run now; empty: all. The report has all there is.
  std::vector<std::string> only;
  int most = 0;        ///< runs now, 0: all
  int jobs = 1;        ///< runs at once, [1, 256]
  bool again = false;  ///< what failed before is tried again
  bool judge = false;  ///< nothing is run: what is kept is compared
};
/// Throws InvalidInput.
void validate(const PressureOptions& options);

/// Where pressures are read: at an outlet, behind all narrowings.
struct PressureReading {
  std::string vessel;
  double s_mm = 0.0;
  double ffr_1d = 0.0, ffr_3d = 0.0;
  double fitted = 0.0;          ///< FFR 1D with the fitted constants
  std::optional<double> exact;  ///< FFR 1D of the exact sections
  double difference() const { return ffr_1d - ffr_3d; }
};
/// Along one vessel's own part; pressures are above the root's (0 there), mmHg.
struct PressureCurve {
  std::string vessel;
  std::vector<double> s_mm, diameter_mm, mmhg_1d, mmhg_3d;
};
/// A case with both.
struct PressureRow {
  PressureCase planned;
  PressureRun run;
  std::string failure;  ///< of either; empty: the members below hold
  std::vector<PressureReading> readings;
  double rms_mmhg = 0.0;  ///< along all its vessels
  std::vector<PressureCurve> curves;
};
/// A case on three meshes, the finest first.
struct ConvergenceRow {
  std::string id;
  std::vector<double> edge_ratios, drops_mmhg;  ///< from the root to the (first) place of reading
  std::vector<std::size_t> cells;
  std::optional<double> order;  ///< observed; none where the three do not fall in line
  std::optional<double> richardson_mmhg;
};
/// The model's two constants of profiles, fitted to the fitting half.
struct PressureFit {
  double development = 0.0, layer_friction = 0.0;
  std::size_t readings = 0;
  double rms_before = 0.0, rms_after = 0.0;  ///< of the difference of FFR in the fitting half
};
struct PressureResults {
  std::vector<PressureRow> rows;  ///< in the plan's order, patients last; those that were run
  std::vector<ConvergenceRow> convergence;
  std::optional<PressureFit> fit;
  std::size_t planned = 0;  ///< how many the plan has, patients among them
  double aortic_mmhg = 96.0;
};

/// Of one group of readings.
struct PressureSummary {
  std::size_t cases = 0, readings = 0;
  double bias = 0.0, sd = 0.0, worst = 0.0;     ///< FFR 1D less 3D
  double alike = 0.0;                           ///< share decided alike at 0.80
  double rms_mmhg = 0.0, worst_rms_mmhg = 0.0;  ///< of the cases
  std::string worst_id;
};
enum class PressureHalf { fitting, judging, patients };
PressureHalf half_of(const PressureCase& one);
/// "fit", "judge", "patient".
std::string_view name_of(PressureHalf half);
/// `fitted`: with the fitted constants. Failed rows, runs that did not converge and the tube are left out.
PressureSummary summarize(const PressureResults& results, PressureHalf half, bool fitted = false);

/// Pressure's fall along the tube over Poiseuille's for its circle, less 1; nothing where it was not run.
std::optional<double> poiseuille_error(const PressureResults& results);

/// The model that the experiment compares: the profile at the root is developed, as the inlets' is.
hemodynamics::FlowModel compared_model();
/// Sections as `ostia ffr` measures them on the same walls, at the flows that the run has. Throws
/// InvalidInput where the run tells no pressure at the root or the outlets.
PressureRow compare_pressure(const PressureCase& one, const lumen::LumenModel& model, const PressureRun& run,
                             const core::TaskContext& task = core::no_task());

/// Runs what is not kept yet (N at once), then compares all that is kept. Throws InvalidInput for options and
/// a folder that keeps runs of another plan, IoError where OpenFOAM is missing and something is to be run,
/// Cancelled; what was finished is kept.
PressureResults run_pressure(const PressureOptions& options, const PressureRunner& runner,
                             const core::TaskContext& task = core::no_task());

/// What decides whether the experiment was done already.
std::string parameters_json(const PressureOptions& options);
/// docs/schemas/experiment-pressure.schema.json.
std::string pressure_json(const PressureResults& results, const PressureOptions& options);
std::string pressure_text(const PressureResults& results);
/// cases.csv, curves.csv, tables.md, agreement.png, worst-*.png, report.html into a folder that is there.
void write_pressure_report(const std::filesystem::path& folder, const PressureResults& results,
                           const PressureOptions& options);

}  // namespace ostia::experiments
