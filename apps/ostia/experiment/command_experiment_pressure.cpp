// `ostia experiment pressure`: pressure along vessels in one dimension against OpenFOAM's in three.

#include "experiment/experiment.h"
#include "options/validators.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/experiments/pressure.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <memory>

namespace ostia::app {
namespace {

struct PressureCommand {
  std::filesystem::path output;
  experiments::PressureOptions options;
  experiments::OpenfoamRunnerOptions runner;
  double timeout_min = 120.0;
  bool one_mesh = false, json = false;
};

experiments::PressureOptions checked(const PressureCommand& command) {
  experiments::PressureOptions options = command.options;
  if (command.one_mesh) options.other_edge_ratios.clear();
  try {
    experiments::validate(options);
  } catch (const InvalidInput& error) {
    throw UsageError(error.what());
  }
  return options;
}

/// What is kept, by content: a report of it is done again where there is more than it was made of.
std::map<std::string, std::string> kept_runs(const std::filesystem::path& keep) {
  std::map<std::string, std::string> runs;
  if (!std::filesystem::is_directory(keep)) return runs;
  for (const auto& entry : std::filesystem::directory_iterator(keep))
    if (entry.is_regular_file() && entry.path().extension() == ".json")
      runs[entry.path().stem().string()] = core::sha256_file(entry.path());
  return runs;
}

ExitCode run_experiment_pressure(const PressureCommand& command, const core::TaskContext& task) {
  const experiments::PressureOptions options = checked(command);
  experiments::OpenfoamRunnerOptions runner = command.runner;
  runner.timeout_s = 60.0 * command.timeout_min;
  experiments::PressureResults results;
  pipeline::JobKey key{"experiment pressure", kept_runs(options.keep), experiments::parameters_json(options)};
  const ExitCode code = run_experiment(
      command.output, key, command.json,
      [&](const std::filesystem::path& folder, const core::TaskContext& part) {
        results = experiments::run_pressure(options, experiments::openfoam_runner(runner), part);
        experiments::write_pressure_report(folder, results, options);
        key.inputs = kept_runs(options.keep);  // this run's among them
        return experiments::pressure_json(results, options);
      },
      task);
  if (!command.json && !results.rows.empty()) std::fputs(experiments::pressure_text(results).c_str(), stdout);
  return code;
}

void add_plan(CLI::App& sub, experiments::PressureOptions& o) {
  const auto count = [&](const char* name, int& value, const char* what) {
    sub.add_option(name, value, what)->check(CLI::Range(0, 1000));
  };
  count("--concentric", o.plan.concentric, "Vessels with one round narrowing, in the plan");
  count("--eccentric", o.plan.eccentric, "Vessels whose throat lies aside and is oval");
  count("--tapered", o.plan.tapered, "Vessels that taper");
  count("--bends", o.plan.bend, "Vessels with a narrowing in a bend");
  count("--series", o.plan.series, "Vessels with two narrowings");
  count("--forks", o.plan.fork, "Forks, of Medina's seven kinds in turn");
  sub.add_option("--edge-ratio", o.mesh.edge_ratio, "Edges of the meshes over the radius")
      ->check(CLI::Range(0.05, 1.0));
  sub.add_option("--layers", o.mesh.layers, "Of prisms on the wall")->check(CLI::Range(0, 10));
  sub.add_option("--iterations", o.mesh.iterations, "Of simpleFoam at most")->check(CLI::Range(10, 1000000));
}

}  // namespace

void define_experiment_pressure(CLI::App& experiment, const std::uint64_t& seed,
                                std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<PressureCommand>();
  experiments::PressureOptions& o = command->options;
  CLI::App* sub = experiment.add_subcommand(
      "pressure", "Pressure along stenosed vessels in one dimension (as `ffr`) against OpenFOAM's in three");
  sub->footer("Example:\n  ostia experiment pressure -o out --keep runs --jobs 2");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--keep", o.keep,
                  "Folder that keeps each run as it is finished: what is in it is not run again")
      ->required();
  add_plan(*sub, o);
  sub->add_flag("--one-mesh", command->one_mesh, "No other meshes of three of the cases");
  sub->add_option("--masks", o.masks, "Folder of patients' masks; left out: no patients");
  sub->add_option("--patients", o.patients, "Files in it, without .nrrd")->delimiter(',');
  sub->add_option("--only", o.only,
                  "Cases, kinds or halves (fit, judge) to be run now; the report has all that is kept")
      ->delimiter(',');
  sub->add_option("--most", o.most, "Runs now, at most; 0: all")->check(CLI::Range(0, 100000));
  sub->add_flag("--judge", o.judge, "Runs nothing: all that is kept is compared anew")
      ->excludes("--only")
      ->excludes("--most");
  sub->add_option("--jobs", o.jobs, "Runs at the same time, one processor each")->check(CLI::Range(1, 256));
  sub->add_option("--timeout", command->timeout_min, "Of one solution, minutes")->check(above_zero());
  sub->add_flag("--again", o.again, "Runs that failed are tried again");
  sub->add_flag("--keep-cases", command->runner.keep_cases,
                "Meshes and fields stay in the folder of runs, 100 MB each");
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.plan.first_seed = seed;
    run = [command](const core::TaskContext& task) { return run_experiment_pressure(*command, task); };
  });
}

}  // namespace ostia::app
