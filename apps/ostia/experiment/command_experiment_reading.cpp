// `ostia experiment reading`: how many actions a simulated reader takes to a tree that is right.

#include "experiment/experiment.h"

#include "ostia/experiments/reading.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct ReadingCommand {
  std::filesystem::path output;
  experiments::ReadingPatients options;
  std::string suite = "full";
  bool json = false;
};

ExitCode run_experiment_reading(const ReadingCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  std::vector<experiments::ReadingRun> runs;
  const ExitCode code = run_experiment(
      command.output, {"experiment reading", {}, experiments::parameters_json(command.options)}, command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        runs = experiments::read_patients(command.options, part);
        experiments::write_reading_report(folder, runs, command.options);
        return experiments::reading_json(runs, command.options);
      },
      task);
  if (!command.json && !runs.empty()) std::fputs(experiments::reading_text(runs).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_reading(CLI::App& experiment, const std::uint64_t& seed,
                               std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<ReadingCommand>();
  experiments::ReadingPatients& options = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "reading",
      "How many actions a simulated reader takes to a tree that is right, with the search and without");
  sub->footer("Example:\n  ostia experiment reading -o out --patients 2");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--patients", options.patients, "How many, with the seeds from --seed on")
      ->check(CLI::Range(1, 200));
  sub->add_option("--voxel", options.voxel_mm, "Of the images, in the plane, mm")
      ->check(CLI::Range(0.35, 2.0));
  sub->add_option("--suite", command->suite, "Patients and scans: full (as drawn) or hard")
      ->check(CLI::IsMember({"full", "hard"}));
  CLI::Option* noise = sub->add_option("--noise", options.noise_hu, "Of the images of the suite full, HU")
                           ->check(CLI::Range(0.0, 500.0));
  CLI::Option* motion = sub->add_option("--motion", options.motion_mm,
                                        "During the exposure, of the images of the suite full, mm")
                            ->check(CLI::Range(0.0, 10.0));
  sub->add_option("--tolerance", options.reader.tolerance_mm, "Of wall and axis, mm")
      ->check(CLI::Range(0.1, 2.0));
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, noise, motion, &seed, &run] {
    command->options.first_seed = seed;
    command->options.hard = command->suite == "hard";
    if (command->options.hard && (noise->count() > 0 || motion->count() > 0))
      throw UsageError("--suite hard draws noise and motion by itself: leave out --noise and --motion");
    run = [command](const core::TaskContext& task) { return run_experiment_reading(*command, task); };
  });
}

}  // namespace ostia::app
