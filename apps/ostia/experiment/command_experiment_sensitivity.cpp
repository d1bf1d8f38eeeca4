// `ostia experiment sensitivity`: what each parameter of the segmentation does to lumina that are known.

#include "experiment/experiment.h"

#include "ostia/experiments/sensitivity.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct SensitivityCommand {
  std::filesystem::path output;
  experiments::SensitivityOptions options;
  std::string only;
  bool json = false;
};

ExitCode run_experiment_sensitivity(const SensitivityCommand& command, const core::TaskContext& task) {
  experiments::SensitivityResult result;
  const experiments::SensitivityOptions& options = command.options;
  const ExitCode code = run_experiment(
      command.output, {"experiment sensitivity", {}, experiments::parameters_json(options, command.only)},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        const std::vector<experiments::KnownLumen> lumina{experiments::stenosed_lumen(options.seed),
                                                          experiments::forked_lumen(options.seed),
                                                          experiments::coronary_lumen(options.seed)};
        result = experiments::run_sensitivity(lumina, options, command.only, part);
        experiments::write_sensitivity_report(folder, result);
        return experiments::sensitivity_json(result, options);
      },
      task);
  if (!command.json) std::fputs(experiments::sensitivity_text(result).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_sensitivity(CLI::App& experiment, const std::uint64_t& seed,
                                   std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<SensitivityCommand>();
  CLI::App* sub = experiment.add_subcommand(
      "sensitivity",
      "How volume, diameters and axis of known lumina depend on each parameter of the segmentation");
  sub->footer("Example:\n  ostia experiment sensitivity -o out");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--only", command->only, "Parameters whose name holds this text (\"curvature\")");
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_sensitivity(*command, task); };
  });
}

}  // namespace ostia::app
