// `ostia experiment orientations`: one phantom scanned in twelve orientations, its tubes measured in each.

#include "experiment/experiment.h"
#include "options/validators.h"

#include "ostia/core/error.h"
#include "ostia/experiments/orientations_report.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct OrientationsCommand {
  std::filesystem::path output;
  experiments::OrientationsOptions options;
  int orientations = 12;
  bool json = false;
};

ExitCode run_experiment_orientations(const OrientationsCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  std::vector<experiments::Orientation> orientations = experiments::twelve_orientations();
  orientations.resize(static_cast<std::size_t>(command.orientations));
  std::vector<experiments::OrientationRun> runs;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment orientations", {}, experiments::parameters_json(command.options, orientations.size())},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        runs = experiments::measure_orientations(experiments::vascular_phantom(), orientations,
                                                 command.options, part);
        experiments::write_orientations_report(folder, runs, command.options);
        return experiments::orientations_json(runs, command.options);
      },
      task);
  if (!command.json && !runs.empty()) std::fputs(experiments::orientations_text(runs).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_orientations(CLI::App& experiment, const std::uint64_t& seed,
                                    std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<OrientationsCommand>();
  experiments::OrientationsOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "orientations", "A phantom of 17 tubes scanned in 12 orientations: lengths and radii from each");
  sub->footer("Example:\n  ostia experiment orientations -o out");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--orientations", command->orientations, "How many of the twelve")
      ->check(CLI::Range(2, 12));
  sub->add_option("--noise", o.scan.noise_hu, "Standard deviation in the scans, HU")
      ->check(CLI::Range(0.0, 500.0));
  sub->add_option("--iterations", o.iterations, "Of the level set, at most")->check(zero_or_above());
  sub->add_option("--inflation", o.inflation, "Weight of the balloon of intensities");
  sub->add_option("--prune", o.prune_mm, "Leaves shorter than this go, mm")->check(zero_or_above());
  sub->add_option("--gap", o.gap_mm, "Gaps up to this are closed, mm")->check(zero_or_above());
  sub->add_option("--sigma", o.sigma_mm, "Of the Gaussian that the walls are found with, mm")
      ->check(above_zero());
  sub->add_flag("!--as-thinned", o.settle, "Junctions and ends stay where thinning leaves them");
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.scan.seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_orientations(*command, task); };
  });
}

}  // namespace ostia::app
