#pragma once
/// \file `ostia skeleton`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace ostia::app {

struct SkeletonCommand {
  InputOptions input;              ///< mask
  std::filesystem::path image;     ///< the CT for the sections; empty: the mask alone
  std::filesystem::path output;    ///< lines
  std::filesystem::path sections;  ///< table of the sections; empty: none
  std::vector<std::string> inlets;
  std::vector<std::string> cuts, removals, connections;  ///< x,y,z; connections x,y,z:x,y,z
  double prune_mm = 5.0, gap_mm = 2.0, sigma_mm = 0.4, blur_mm = 0.0, knots_mm = 4.0, step_mm = 0.5;
  bool no_loops = false, keep_cavities = false;
  bool json = false;
};
ExitCode run_skeleton(const SkeletonCommand& options, const core::TaskContext& task);

/// Adds `skeleton`.
void define_skeleton(CLI::App& app, SkeletonCommand& skeleton,
                     std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
