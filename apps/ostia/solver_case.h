#pragma once
/// \file `ostia case`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct CaseCommand {
  std::filesystem::path mesh;    ///< volume mesh with named faces
  std::filesystem::path output;  ///< folder that is made
  std::string solver = "openfoam";
  std::vector<std::string> flow;  ///< ml/s, or INLET=ml/s
  std::optional<double> velocity_cm_s, reynolds;
  std::string waveform;  ///< coronary-left, coronary-right or a table; empty: steady
  std::optional<double> period_s;
  std::string outlets = "zero";
  double split_exponent = 2.27;
  std::optional<double> resistance, compliance;
  double density = 1060.0, viscosity = 3.5;
  std::string rheology = "newton";
  int cycles = 3, processes = 2, iterations = 2000;
  std::optional<double> time_step_s;
};
ExitCode run_case(const CaseCommand& options, const core::TaskContext& task);

/// Adds `case`.
void define_case(CLI::App& app, CaseCommand& command, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
