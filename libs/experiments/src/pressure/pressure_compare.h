#pragma once
/// \file One dimension at the flows of three.

#include "ostia/experiments/pressure.h"
#include "ostia/hemodynamics/network_solver.h"

#include <string>
#include <vector>

namespace ostia::experiments {

/// Pressures of sections of one vessel, linear between them.
class SectionPressures {
 public:
  SectionPressures(const std::vector<SectionPressure>& sections, std::int32_t vessel);
  bool known_at(double s_mm) const;
  double at(double s_mm) const;  ///< Pa; NaN where it is not known

 private:
  std::vector<double> s_mm_, pa_;
};

/// A case with its network and its run: what can be asked again with other constants.
struct PressureProblem {
  PressureCase planned;
  hemodynamics::Network network;
  std::vector<std::string> outlet_names;  ///< vessels, in the order of hemodynamics::outlets_of
  PressureRun run;
};
/// Throws InvalidInput where the run has no flow for an outlet.
PressureProblem problem_of(const PressureCase& one, hemodynamics::Network network, const PressureRun& run);

/// Pressures of one dimension at the run's flows: of each branch's stations, Pa.
std::vector<std::vector<double>> pressures_1d(const PressureProblem& problem,
                                              const hemodynamics::FlowModel& model);
/// Readings at all outlets, both pressures held against each other from the same place of the root on.
std::vector<PressureReading> readings_of(const PressureProblem& problem,
                                         const hemodynamics::FlowModel& model);
/// Readings and curves of a problem.
PressureRow row_of(const PressureProblem& problem);
/// Sections as `ostia ffr` measures them.
hemodynamics::Network measured_network(const lumen::LumenModel& model, const core::TaskContext& task);

/// Roache's extrapolation where three drops fall in line, for one ratio from mesh to mesh; else nothing.
void extrapolate(ConvergenceRow& row);
/// A row that the figures are made of.
bool counts(const PressureRow& row);

/// The constants by which the readings of the fitting half differ least; nothing for fewer than five.
std::optional<PressureFit> fit_pressure(const std::vector<PressureProblem>& problems);

}  // namespace ostia::experiments
