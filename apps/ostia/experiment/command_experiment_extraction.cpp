// `ostia experiment extraction`: the tree and the lumen found without a click, held against the truth.

#include "experiment/experiment.h"
#include "options/validators.h"

#include "ostia/core/files.h"
#include "ostia/experiments/extraction_report.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>

#include <cstdio>
#include <map>
#include <memory>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

struct ExtractionCommand {
  fs::path suite, output;
  experiments::ExtractionScoreOptions options;
  bool json = false;
};

/// What the experiment reads of a suite, by content.
std::map<std::string, std::string> extraction_inputs(const fs::path& suite) {
  std::map<std::string, std::string> inputs;
  if (!fs::is_directory(suite)) return inputs;
  const auto add = [&](const fs::path& file) {
    if (fs::is_regular_file(file))
      inputs[file.parent_path().filename().string() + "/" + file.filename().string()] =
          core::sha256_file(file);
  };
  for (const auto& entry : fs::directory_iterator(suite)) {
    if (!entry.path().filename().string().starts_with("dataset")) continue;
    for (const char* name : {"case.json", "centerlines.vtp", "contours.json"}) add(entry.path() / name);
    const fs::path image = experiments::image_of_case(entry.path());
    add(image);
    if (image.extension() == ".mhd") add(fs::path(image).replace_extension(".raw"));
  }
  return inputs;
}

ExitCode run_experiment_extraction(const ExtractionCommand& command, const core::TaskContext& task) {
  experiments::validate(command.options);
  std::vector<experiments::ExtractionRun> runs;
  const ExitCode code = run_experiment(
      command.output,
      {"experiment extraction", extraction_inputs(command.suite),
       experiments::parameters_json(command.options)},
      command.json,
      [&](const fs::path& folder, const core::TaskContext& part) {
        runs = experiments::extract_suite(command.suite, command.options, part);
        experiments::write_extraction_report(folder, runs, command.options);
        return experiments::extraction_json(runs, command.options);
      },
      task);
  if (!command.json && !runs.empty())
    std::fputs(experiments::extraction_text(runs, command.options).c_str(), stdout);
  return code;
}

}  // namespace

void define_experiment_extraction(CLI::App& experiment,
                                  std::function<ExitCode(const core::TaskContext&)>& run) {
  const auto command = std::make_shared<ExtractionCommand>();
  CLI::App* extraction = experiment.add_subcommand(
      "extraction", "Finds the coronary tree and its lumen in every image of a suite and scores them");
  extraction->footer(
      "Example:\n  ostia phantom -o suite --preset full --cases 18 --formats nrrd --no-report\n  ostia "
      "experiment extraction --suite suite -o out");
  extraction->fallthrough();
  extraction
      ->add_option("--suite", command->suite, "Folder of a suite with images, as `ostia phantom` makes it")
      ->required();
  extraction->add_option("-o,--output", command->output, "Folder that is made")->required();
  extraction
      ->add_option("--astray", command->options.astray_mm,
                   "A found axis so far outside of every true lumen follows no artery, mm")
      ->check(above_zero());
  extraction->add_option("--threshold", command->options.threshold, "Diameter stenosis that is to be found")
      ->check(CLI::Range(0.01, 0.99));
  extraction->add_flag("--json", command->json, "The figures as JSON on standard output");
  extraction->callback([command, &run] {
    run = [command](const core::TaskContext& task) { return run_experiment_extraction(*command, task); };
  });
}

}  // namespace ostia::app
