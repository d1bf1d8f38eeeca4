#pragma once
/// \file `ostia result`: what it is told.

#include "commands.h"

#include <filesystem>
#include <functional>

namespace CLI {
class App;
}

namespace ostia::app {

struct ResultCommand {
  std::filesystem::path flow_case;  ///< folder of `ostia case` that has been run
  std::filesystem::path mesh;       ///< instead of the mesh.vtu in it
  std::filesystem::path output;     ///< folder that is made
  double low_shear_pa = 0.4, high_shear_pa = 7.0;
  bool json = false;
};
ExitCode run_result(const ResultCommand& options, const core::TaskContext& task);

/// Adds `result`.
void define_result(CLI::App& app, ResultCommand& result,
                   std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
