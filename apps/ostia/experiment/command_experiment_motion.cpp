// `ostia experiment motion`: the template of a coronary tree carried through the phases of hearts whose
// motion is known, by depth, by method and by the phases that are known.

#include "experiment/experiment.h"
#include "options/validators.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/motion.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <map>
#include <memory>

namespace ostia::app {
namespace {

struct MotionCommand {
  std::filesystem::path output;
  experiments::MotionOptions options;
  std::vector<std::string> methods;
  std::vector<double> compared_percent;
  bool json = false;
};

experiments::MotionOptions options_of(const MotionCommand& command) {
  experiments::MotionOptions options = command.options;
  if (!command.methods.empty()) {
    options.methods.clear();
    for (const std::string& one : command.methods)
      if (one != "none") options.methods.push_back(experiments::motion_method_of(one));
  }
  if (!command.compared_percent.empty()) {
    options.compared_phases.clear();
    for (const double percent : command.compared_percent) options.compared_phases.push_back(percent / 100.0);
  }
  return options;
}

/// What the options ask for must be possible before anything is begun.
experiments::MotionOptions checked(const MotionCommand& command) {
  try {
    experiments::MotionOptions options = options_of(command);
    experiments::validate(options);
    return options;
  } catch (const InvalidInput& error) {
    throw UsageError(std::string("experiment motion: ") + error.what());
  }
}

/// What is kept, by content: a report of it is done again where there is more than it was made of.
std::map<std::string, std::string> kept_inputs(const std::filesystem::path& keep) {
  std::map<std::string, std::string> inputs;
  if (keep.empty()) return inputs;
  for (const char* name : {"runs.csv", "branches.csv"})
    if (std::filesystem::is_regular_file(keep / name)) inputs[name] = core::sha256_file(keep / name);
  return inputs;
}

ExitCode run_experiment_motion(const MotionCommand& command, const core::TaskContext& task) {
  const experiments::MotionOptions options = checked(command);
  experiments::MotionResults results;
  pipeline::JobKey key{"experiment motion", kept_inputs(options.keep), experiments::parameters_json(options)};
  const ExitCode code = run_experiment(
      command.output, key, command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        results = experiments::run_motion(options, part);
        experiments::write_motion_report(folder, results, options);
        key.inputs = kept_inputs(options.keep);  // this run's among them
        return experiments::motion_json(results, options);
      },
      task);
  if (!command.json && !results.runs.empty()) std::fputs(experiments::motion_text(results).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_motion(CLI::App& experiment, const std::uint64_t& seed,
                              std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<MotionCommand>();
  experiments::MotionOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "motion",
      "Coronary trees carried through the beat: depths of the cage, methods, phases that are known");
  sub->footer("Example:\n  ostia experiment motion -o out --hearts 2 --depths 4 --methods none");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--hearts", o.hearts, "How many")->check(CLI::Range(1, 100));
  sub->add_option("--phases", o.heart.phases, "Of a beat: 4, 8, 12, ...");
  sub->add_option("--noise", o.heart.noise_mm, "Deviation of the segmented wall, mm");
  sub->add_option("--loss", o.heart.phases_with_loss, "Share of the phases that lack a branch");
  sub->add_option("--depths", o.depths, "Of the cage")->delimiter(',');
  sub->add_option("--depth", o.depth, "Of the cage in all that is compared otherwise");
  sub->add_option("--methods", command->methods,
                  "To compare: cage-rest, descent, descent-free, tps-l2, tps-kc, grbf-l2, grbf-kc; or none")
      ->delimiter(',');
  sub->add_option("--compared-phases", command->compared_percent, "At these, % of RR")->delimiter(',');
  sub->add_option("--compared-hearts", o.compared_hearts, "Of the first so many hearts")
      ->check(zero_or_above());
  sub->add_option("--keep", o.keep,
                  "Folder that keeps each run as it is finished: what is in it is not run again");
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.heart.seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_motion(*command, task); };
  });
}

}  // namespace ostia::app
