#pragma once
/// \file A case of OpenFOAM run here, watched by what its program writes.

#include "ostia/core/task_context.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace ostia::solver {

/// What a case's controlDict and fvSolution say about its run.
struct OpenfoamRunPlan {
  std::string program;      ///< simpleFoam (steady), pimpleFoam; pisoFoam in cases of version 0.1
  double end_time = 0.0;    ///< iterations at most, or s
  double tolerance = 1e-6;  ///< of a steady run: initial residuals at which it ends
  bool steady() const { return program == "simpleFoam"; }
};
/// Throws InvalidInput where the folder is no case that write_openfoam_case wrote, IoError.
OpenfoamRunPlan openfoam_run_plan(const std::filesystem::path& case_folder);

/// How far a log has come.
struct OpenfoamProgress {
  double time = 0.0;               ///< the last that was begun: an iteration, or s
  std::optional<double> residual;  ///< the largest initial one of the last that is complete
  bool converged = false;          ///< it says so
};
/// Of the end of a log, from any place on; what is cut off at its ends does no harm.
OpenfoamProgress progress_of_log(std::string_view log_end);
/// In [0, 1]: a steady run's by its iterations or, where that is more, by the logarithm of its residual.
double share_done(const OpenfoamProgress& progress, const OpenfoamRunPlan& plan);

/// OpenFOAM strips blanks and quotation marks out of the path of the folder that it works in.
bool openfoam_can_work_in(const std::filesystem::path& folder);

/// Runs `Allrun` of a case as a child process until it ends. Progress and stage ("iteration, residual: 57,
/// 3e-04", "time, s: 0.1 / 2.4") come from the program's log. On cancel all its processes are ended before
/// Cancelled is thrown; the case stays with what was written; they also end within seconds of this
/// process's death. Throws InvalidInput where OpenFOAM cannot work in the folder, IoError where the program
/// is not installed, NumericalError with the last lines of the log where it fails, ResourceError where a
/// signal ends it from outside, and what openfoam_run_plan throws.
OpenfoamProgress run_openfoam_case(const std::filesystem::path& case_folder,
                                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::solver
