#include "experiment/experiment.h"

#include "ostia/core/files.h"
#include "ostia/core/log.h"
#include "ostia/experiments/editing_report.h"
#include "ostia/pipeline/manifest.h"

#include <chrono>
#include <cstdio>
#include <fstream>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

using Clock = std::chrono::steady_clock;
using geometry::Health;

experiments::EditingOptions options_of(const ExperimentCommand& command) {
  experiments::EditingOptions options;
  options.observer = command.observer;
  options.reader.seed = command.seed;
  if (command.start_excess_mm >= 0.0) options.start_excess_mm = command.start_excess_mm;
  if (command.pointing_mm >= 0.0) options.reader.pointing_sigma_mm = command.pointing_mm;
  if (command.visible_px > 0.0) options.reader.visible_px = command.visible_px;
  if (command.points > 0) options.reader.points = command.points;
  return options;
}

/// What the experiment reads of a suite, by content.
std::map<std::string, std::string> inputs_of(const fs::path& suite) {
  std::map<std::string, std::string> inputs;
  if (!fs::is_directory(suite)) return inputs;
  for (const auto& entry : fs::directory_iterator(suite)) {
    for (const char* name : {"centerlines.vtp", "contours.json"}) {
      const fs::path file = entry.path() / name;
      if (fs::is_regular_file(file))
        inputs[entry.path().filename().string() + "/" + name] = core::sha256_file(file);
    }
  }
  return inputs;
}

void print(const std::vector<experiments::SectionRun>& runs) {
  std::printf("%-9s %8s %7s  %17s  %17s  %9s %8s %11s\n", "lumen", "sections", "mm", "MSD start -> end",
              "max SD start -> end", "to truth", "strokes", "on sections");
  for (const Health health : {Health::healthy, Health::diseased}) {
    const experiments::EditingSummary s = experiments::summarize(runs, health);
    std::printf("%-9s %8zu %7.0f  %6.3f -> %6.3f mm  %6.2f -> %6.2f mm  %6.3f mm %8.1f %9.0f %%\n",
                health == Health::healthy ? "healthy" : "diseased", s.sections, s.length_mm, s.start.msd_mm,
                s.final.msd_mm, s.start.max_sd_mm, s.final.max_sd_mm, s.final_to_truth.msd_mm,
                s.median_strokes, 100.0 * s.section_share);
  }
}

}  // namespace

ExitCode run_experiment(const fs::path& output, const pipeline::JobKey& key, bool json,
                        const ExperimentWork& work, const core::TaskContext& task) {
  const auto start = Clock::now();
  pipeline::require_free_folder(output);
  if (const auto code = pipeline::already_done(output, key)) {
    core::log_info("done already with the same inputs and parameters; nothing to do");
    if (json) std::fputs(core::read_file(output / "experiment.json").c_str(), stdout);
    return *code;
  }
  core::StagedFolder folder(output);
  const std::string figures = work(folder.temporary(), task.sub(0.0, 0.95));
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  core::write_file(folder.temporary() / "experiment.json", figures);
  pipeline::write_manifest(folder.temporary(), {key, ExitCode::ok, seconds, {}, figures});
  folder.commit();
  task.set_progress(1.0);
  if (json) std::fputs(figures.c_str(), stdout);
  return ExitCode::ok;
}

ExitCode run_experiment_editing(const ExperimentCommand& command, const core::TaskContext& task) {
  const experiments::EditingOptions options = options_of(command);
  experiments::validate(options);
  std::vector<experiments::SectionRun> runs;
  const ExitCode code = run_experiment(
      command.output, {"experiment editing", inputs_of(command.suite), experiments::parameters_json(options)},
      command.json,
      [&](const fs::path& folder, const core::TaskContext& part) {
        runs = experiments::edit_suite(command.suite, options, part);
        experiments::write_editing_report(folder, runs, options);
        return experiments::editing_json(runs, options);
      },
      task);
  if (!command.json && !runs.empty()) print(runs);
  return code;
}

}  // namespace ostia::app
