// `ostia experiment smoothness`: surfaces reconstructed from one phantom's scans, beside VTK's isosurfaces.

#include "experiment/experiment.h"
#include "options/validators.h"

#include "ostia/experiments/smoothness_report.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct SmoothnessCommand {
  std::filesystem::path output;
  experiments::SmoothnessOptions options;
  int orientations = 12;
  bool json = false;
};

ExitCode run_experiment_smoothness(const SmoothnessCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  std::vector<experiments::Orientation> orientations = experiments::twelve_orientations();
  orientations.resize(static_cast<std::size_t>(command.orientations));
  std::vector<experiments::SurfaceFigures> surfaces;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment smoothness", {}, experiments::parameters_json(command.options, orientations.size())},
      command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        surfaces = experiments::measure_smoothness(experiments::vascular_phantom(), orientations,
                                                   command.options, part);
        experiments::write_smoothness_report(folder, surfaces, command.options);
        return experiments::smoothness_json(surfaces, command.options, orientations.size());
      },
      task);
  if (!command.json && !surfaces.empty()) std::fputs(experiments::smoothness_text(surfaces).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_smoothness(CLI::App& experiment, const std::uint64_t& seed,
                                  std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<SmoothnessCommand>();
  experiments::SmoothnessOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "smoothness", "Surfaces reconstructed from a phantom's scans: smoothness, distance from isosurfaces");
  sub->footer("Example:\n  ostia experiment smoothness -o out");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--orientations", command->orientations, "How many of the twelve")
      ->check(CLI::Range(1, 12));
  sub->add_option("--levels", o.levels, "How many levels of subdivision, from 0 on")->check(CLI::Range(1, 4));
  sub->add_option("--noise", o.scans.scan.noise_hu, "Standard deviation in the scans, HU")
      ->check(CLI::Range(0.0, 500.0));
  sub->add_option("--relaxation", o.relaxation, "Of VTK's smoothing")->check(CLI::Range(0.001, 1.0));
  sub->add_option("--clear", o.clear_mm, "Nearer to joints and ends is not of the tubes alone, mm")
      ->check(above_zero());
  sub->add_option("--sample", o.sample_mm, "Density of the points whose distances are taken, mm")
      ->check(above_zero());
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.scans.scan.seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_smoothness(*command, task); };
  });
}

}  // namespace ostia::app
