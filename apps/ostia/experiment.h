#pragma once
/// \file `ostia experiment`: the papers' experiments, each one command and one table.

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

struct ExperimentCommand {
  std::filesystem::path suite, output;
  std::string observer = "observer1";
  double start_excess_mm = -1.0;  ///< negative: the library's default, as in all below
  double pointing_mm = -1.0, visible_px = -1.0;
  int points = 0;
  bool json = false;
  std::uint64_t seed = 1;
};
ExitCode run_experiment_editing(const ExperimentCommand& command, const core::TaskContext& task);

/// Adds `experiment` and its subcommands; `seed` is read when the command runs.
void define_experiment(CLI::App& app, ExperimentCommand& command, const std::uint64_t& seed,
                       std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
