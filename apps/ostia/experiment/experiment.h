#pragma once
/// \file `ostia experiment`: the papers' experiments, each one command and one table.

#include "ostia/core/error.h"
#include "ostia/core/task_context.h"
#include "ostia/pipeline/manifest.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>

namespace CLI {
class App;
}

namespace ostia::app {

/// What an experiment does: writes its tables and pictures into `folder` and returns its figures as JSON.
using ExperimentWork =
    std::function<std::string(const std::filesystem::path& folder, const core::TaskContext& task)>;

/// Runs `work` into the folder `output`, which appears whole or not at all, with the figures as
/// experiment.json and a manifest; where `key` was done there before, nothing is done. `json`: the figures on
/// standard output, too.
ExitCode run_experiment(const std::filesystem::path& output, const pipeline::JobKey& key, bool json,
                        const ExperimentWork& work, const core::TaskContext& task);

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

/// Each adds its own subcommand of `experiment`.
void define_experiment_extraction(CLI::App& experiment,
                                  std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_orientations(CLI::App& experiment, const std::uint64_t& seed,
                                    std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_smoothness(CLI::App& experiment, const std::uint64_t& seed,
                                  std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_chain(CLI::App& experiment, std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_robustness(CLI::App& experiment, const std::uint64_t& seed,
                                  std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_reading(CLI::App& experiment, const std::uint64_t& seed,
                               std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_hard(CLI::App& experiment, const std::uint64_t& seed,
                            std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_certainty(CLI::App& experiment, const std::uint64_t& seed,
                                 std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_motion(CLI::App& experiment, const std::uint64_t& seed,
                              std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_carotid(CLI::App& experiment, const std::uint64_t& seed,
                               std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_sensitivity(CLI::App& experiment, const std::uint64_t& seed,
                                   std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_pressure(CLI::App& experiment, const std::uint64_t& seed,
                                std::function<ExitCode(const core::TaskContext&)>& run);

void define_experiment_wall_spread(CLI::App& experiment, const std::uint64_t& seed,
                                   std::function<ExitCode(const core::TaskContext&)>& run);

/// Adds `experiment` and its subcommands; `seed` is read when the command runs.
void define_experiment(CLI::App& app, ExperimentCommand& command, const std::uint64_t& seed,
                       std::function<ExitCode(const core::TaskContext&)>& run);

}  // namespace ostia::app
