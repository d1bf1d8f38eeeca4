// `ostia experiment robustness`: one thing at a time is made worse until the tree that is found breaks.

#include "experiment/experiment.h"

#include "ostia/core/error.h"
#include "ostia/experiments/robustness.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <algorithm>
#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct RobustnessCommand {
  std::filesystem::path output;
  experiments::RobustnessOptions options;
  std::vector<std::string> only;
  bool json = false;
};

/// Those asked for, and the patient as drawn, which they are compared with.
std::vector<experiments::Variation> chosen(const std::vector<std::string>& only) {
  std::vector<experiments::Variation> all = experiments::usual_variations();
  for (const std::string& one : only)
    if (std::none_of(all.begin(), all.end(), [&](const auto& known) { return known.what == one; }))
      throw UsageError("--only " + one +
                       ": there is no such variation; docs/experiments/robustness.md lists them");
  if (!only.empty())
    std::erase_if(all, [&](const experiments::Variation& one) {
      return one.what != all.front().what && std::find(only.begin(), only.end(), one.what) == only.end();
    });
  return all;
}

ExitCode run_experiment_robustness(const RobustnessCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  const std::vector<experiments::Variation> variations = chosen(command.only);
  std::vector<experiments::RobustnessRun> runs;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment robustness", {}, experiments::parameters_json(variations, command.options)}, command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        runs = experiments::vary_patients(variations, command.options, part);
        experiments::write_robustness_report(folder, runs);
        return experiments::robustness_json(runs, command.options);
      },
      task);
  if (!command.json && !runs.empty()) std::fputs(experiments::robustness_text(runs).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_robustness(CLI::App& experiment, const std::uint64_t& seed,
                                  std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<RobustnessCommand>();
  CLI::App* sub = experiment.add_subcommand(
      "robustness",
      "Synthetic patients made worse, one thing at a time, until the tree that is found breaks");
  sub->footer("Example:\n  ostia experiment robustness -o out --only noise,contrast");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--patients", command->options.seeds, "How many, with the seeds from --seed on")
      ->check(CLI::Range(1, 20));
  sub->add_option("--voxel", command->options.voxel_mm, "Of the images, in the plane, mm")
      ->check(CLI::Range(0.5, 2.0));
  sub->add_option("--only", command->only, "Variations, separated by commas; all")->delimiter(',');
  sub->add_flag("--json", command->json, "The table as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.first_seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_robustness(*command, task); };
  });
}

}  // namespace ostia::app
