#pragma once
/// \file `ostia ffr`: what it is told.

#include "commands.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

/// As many trees as the conditions' file says, or the library does.
constexpr std::string_view usual_trees = "usual";

struct FfrCommand {
  std::filesystem::path input;       ///< case, or a tree of lines with radii
  std::filesystem::path output;      ///< folder that is made
  std::filesystem::path conditions;  ///< JSON of inputs; empty: none
  std::optional<double> systolic_mmhg, diastolic_mmhg, heart_rate_bpm, lv_mass_g, rest_flow_ml_min;
  std::vector<std::string> open, narrow;  ///< stretches, as session::what_if_of_text reads them
  double behind_mm = 25.0;
  std::string junctions = "unified";
  std::vector<std::string> exports;  ///< names of hemodynamics::NetworkFormat
  bool pulse = false, unusual = false, json = false;
  std::string uncertainty;               ///< empty: not asked for; "usual", or how many trees are drawn
  std::optional<double> wall_spread_mm;  ///< of a section's mean radius
  std::filesystem::path image;           ///< that the case was made with: its edges tell the walls' spread
  std::optional<std::uint64_t> seed;     ///< where it is told
};
ExitCode run_ffr(const FfrCommand& options, const core::TaskContext& task);
/// Of a case of svZeroDSolver (.json): its own boundaries, its own units.
ExitCode run_ffr_network(const FfrCommand& options, const core::TaskContext& task);

/// Adds `ffr`.
void define_ffr(CLI::App& app, FfrCommand& ffr, const std::uint64_t& seed,
                std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
