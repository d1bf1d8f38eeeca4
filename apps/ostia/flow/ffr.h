#pragma once
/// \file `ostia ffr`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <optional>

namespace CLI {
class App;
}

namespace ostia::app {

struct FfrCommand {
  std::filesystem::path input;       ///< case, or a tree of lines with radii
  std::filesystem::path output;      ///< folder that is made
  std::filesystem::path conditions;  ///< JSON of inputs; empty: none
  std::optional<double> systolic_mmhg, diastolic_mmhg, heart_rate_bpm, lv_mass_g, rest_flow_ml_min;
  double behind_mm = 25.0;
  std::string junctions = "unified";
  bool pulse = false, unusual = false, json = false;
};
ExitCode run_ffr(const FfrCommand& options, const core::TaskContext& task);

/// Adds `ffr`.
void define_ffr(CLI::App& app, FfrCommand& ffr, std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
