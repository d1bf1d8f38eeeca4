// `ostia experiment hard`: two classical methods and the search without a click on the suite `hard`.

#include "experiment/experiment.h"

#include "ostia/core/log.h"
#include "ostia/experiments/hard.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <map>
#include <memory>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

struct HardCommand {
  fs::path output, masks;
  experiments::HardOptions options;
  std::vector<double> strength;  ///< in the order of HardStrength's members; empty: as calibrated
  bool json = false;
};

std::map<std::string, std::string> hard_inputs(const std::vector<experiments::HardPatient>& patients) {
  std::map<std::string, std::string> inputs;
  for (const experiments::HardPatient& one : patients) inputs["mask " + one.name] = one.tree->digest;
  return inputs;
}

ExitCode run_experiment_hard(const HardCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  std::vector<experiments::HardPatient> patients;
  if (!command.masks.empty()) patients = experiments::read_hard_patients(command.masks, task.sub(0.0, 0.05));
  for (const experiments::HardPatient& one : patients)
    for (const std::string& remark : one.tree->remarks) core::log_info(one.name + ": " + remark);
  std::vector<experiments::HardRun> runs;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment hard", hard_inputs(patients), experiments::parameters_json(command.options)}, command.json,
      [&](const fs::path& folder, const core::TaskContext& part) {
        runs = experiments::run_hard(command.options, patients, part);
        experiments::write_hard_report(folder, runs, command.options);
        return experiments::hard_json(runs, command.options);
      },
      task.sub(0.05, 1.0));
  if (!command.json && !runs.empty())
    std::fputs(experiments::hard_text(runs, command.options).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_hard(CLI::App& experiment, const std::uint64_t& seed,
                            std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<HardCommand>();
  CLI::App* sub = experiment.add_subcommand(
      "hard",
      "Two classical methods and the search without a click on patients and scans as a clinic has them");
  sub->footer("Example:\n  ostia experiment hard -o out --cases 10 --masks masks --easy");
  sub->fallthrough();
  sub->add_option("-o,--output", command->output, "Folder that is made")->required();
  sub->add_option("--cases", command->options.cases,
                  "How many of each kind of heart, with the seeds from --seed on")
      ->check(CLI::Range(1, 100));
  sub->add_option("--masks", command->masks,
                  "Folder of patients' coronary masks: as many hearts around their trees, in turn");
  sub->add_flag("--easy", command->options.easy, "The suite full, from the same seeds, beside it");
  sub->add_flag("!--no-search", command->options.search, "The two classical methods alone");
  sub->add_option("--voxel", command->options.voxel_mm, "Of the images, in the plane, mm")
      ->check(CLI::Range(0.35, 2.0));
  sub->add_option(
         "--strength", command->strength,
         "NOISE,BLUR,MOTION,VENOUS[,CONTACT,CALCIUM,FALL,CLOSED]: factors by which the suite is harder than "
         "it is calibrated to be")
      ->delimiter(',')
      ->expected(4, 8)
      ->check(CLI::Range(0.0, 5.0));
  sub->add_flag("--json", command->json, "The figures as JSON on standard output");
  sub->callback([command, &seed, &run] {
    command->options.first_seed = seed;
    if (std::vector<double> s = command->strength; !s.empty()) {
      s.resize(8, 1.0);
      command->options.strength = {s[0], s[1], s[2], s[3], s[4], s[5], s[6], s[7]};
    }
    run = [command](const core::TaskContext& task) { return run_experiment_hard(*command, task); };
  });
}

}  // namespace ostia::app
