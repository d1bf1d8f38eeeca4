// `ostia experiment certainty`: whether the probabilities of found vessels are the shares that are right.

#include "experiment/experiment.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/certainty.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <map>
#include <memory>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

struct CertaintyCommand {
  fs::path suite, output;
  experiments::CertaintyOptions options;
  bool json = false;
};

/// What the experiment reads of a suite, by content.
std::map<std::string, std::string> certainty_inputs(const fs::path& suite) {
  std::map<std::string, std::string> inputs;
  if (suite.empty()) return inputs;
  for (const fs::path& folder : experiments::cases_of_suite(suite)) {
    const fs::path image = experiments::image_of_case(folder);
    for (const fs::path& file : {folder / "centerlines.vtp", folder / "case.json", image})
      if (fs::is_regular_file(file))
        inputs[(folder.filename() / file.filename()).string()] = core::sha256_file(file);
    if (image.extension() == ".mhd")
      inputs[folder.filename().string() + "/raw"] =
          core::sha256_file(fs::path(image).replace_extension(".raw"));
  }
  return inputs;
}

ExitCode run_experiment_certainty(const CertaintyCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  experiments::CertaintyRuns runs;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment certainty", certainty_inputs(command.suite),
       experiments::parameters_json(command.options)},
      command.json,
      [&](const fs::path& folder, const core::TaskContext& part) {
        runs = command.suite.empty() ? experiments::judge_certainty(command.options, part)
                                     : experiments::judge_certainty_of_suite(command.suite, part);
        experiments::write_certainty_report(folder, runs);
        return experiments::certainty_json(runs);
      },
      task);
  if (!command.json && runs.searches > 0) std::fputs(experiments::certainty_text(runs).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_certainty(CLI::App& experiment, const std::uint64_t& seed,
                                 std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<CertaintyCommand>();
  CLI::App* sub = experiment.add_subcommand(
      "certainty",
      "Whether the probability of each found vessel and centimetre is the share that is right, in patients "
      "of many difficulties");
  sub->footer("Example:\n  ostia experiment certainty -o out --patients 4 --seed 201");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  CLI::Option* patients =
      sub->add_option("--patients", command->options.patients, "How many, with the seeds from --seed on")
          ->check(CLI::Range(1, 500));
  CLI::Option* scans = sub->add_option("--scans", command->options.scans,
                                       "Of each patient, drawn from its seed, each with four levels of noise")
                           ->check(CLI::Range(1, 20));
  CLI::Option* voxel =
      sub->add_option("--voxel", command->options.voxel_mm, "Of the images, in the plane, mm")
          ->check(CLI::Range(0.5, 2.0));
  sub->add_option("--suite", command->suite,
                  "Instead of drawn patients: a suite with images, as `ostia phantom` makes it")
      ->excludes(patients)
      ->excludes(scans)
      ->excludes(voxel);
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.first_seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_certainty(*command, task); };
  });
}

}  // namespace ostia::app
