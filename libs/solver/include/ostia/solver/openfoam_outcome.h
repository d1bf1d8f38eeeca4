#pragma once
/// \file How a run of OpenFOAM went: its log, its residuals, and what it measured at each step.

#include "ostia/solver/case_record.h"

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ostia::solver {

/// Values over time (or iterations), as a function object has written them. Where a run was continued, what
/// it wrote before counts up to there.
using OpenfoamSeries = std::map<double, double>;
/// Of postProcessing/<function>/<start>/surfaceFieldValue.dat. Throws InvalidInput where there is none or it
/// holds no numbers.
OpenfoamSeries read_openfoam_series(const std::filesystem::path& case_folder, const std::string& function);

/// The mean over (`last` - `period`, `last`] of what is straight between the values; the value at the start
/// is taken from between its neighbours. Throws InvalidInput where the values do not reach so far.
double cycle_mean(const OpenfoamSeries& series, double last, double period);

struct OpenfoamOutcome {
  std::string program;  ///< simpleFoam, pimpleFoam; pisoFoam in cases of version 0.1
  double last = 0.0;    ///< iteration or time, s
  bool converged = false;
  std::string not_converged;                ///< why not
  std::map<std::string, double> residuals;  ///< initial ones of the last step: Ux, Uy, Uz, p
  std::optional<double> largest_courant;    ///< of a pulsatile run
  /// Of a pulsatile run of two cycles at least: by how much the mean pressures at the inlets differ between
  /// the last two, relative to the last.
  std::optional<double> cycle_change;
};
/// Converged is: a steady run that came below its bounds of the residuals, by its log; a pulsatile one that
/// reached its end and whose last two cycles differ by 1 % at most.
OpenfoamOutcome read_openfoam_outcome(const std::filesystem::path& case_folder, const CaseRecord& record,
                                      const std::vector<std::string>& inlets);

}  // namespace ostia::solver
