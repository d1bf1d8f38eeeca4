#pragma once
/// \file `ostia measure`: what it is told.

#include "commands.h"

#include <filesystem>
#include <optional>

namespace CLI {
class App;
}

namespace ostia::app {

struct MeasureCommand {
  InputOptions input;                ///< tree of vessels, case or surface
  EndOptions ends;                   ///< of a surface
  std::filesystem::path centerline;  ///< of a surface; empty: computed
  std::filesystem::path output;
  bool bifurcations = false, sections = false;
  int section_spheres = 1;                ///< between sections
  std::optional<double> patch_length_mm;  ///< nothing: no patches
  int patch_sectors = 1;
  bool json = false;
};
/// Options for branches, bifurcations, sections and patches.
void add_branch_measures(CLI::App& app, MeasureCommand& command);

ExitCode run_measure(const MeasureCommand& options, const core::TaskContext& task);

}  // namespace ostia::app
