#pragma once
/// \file What a solver's case is told besides its mesh: of `case`, and of `mesh` and `model` with
/// --with-case.

#include <optional>
#include <string>
#include <vector>

namespace ostia::app {

struct CaseOptions {
  std::string solver = "openfoam";  ///< a name of pipeline::solver_kinds
  std::vector<std::string> flow;    ///< ml/s, or INLET=ml/s
  std::optional<double> velocity_cm_s, reynolds;
  std::string waveform;  ///< coronary-left, coronary-right or a table; empty: steady
  std::optional<double> period_s;
  std::string outlets = "zero";
  double split_exponent = 2.27;
  std::optional<double> resistance, compliance;
  double density = 1060.0, viscosity = 3.5;
  std::string rheology = "newton";
  int cycles = 3, processes = 2, iterations = 2000;
  std::optional<double> time_step_s, courant;
};

}  // namespace ostia::app
