// `ostia cohort crate` and `ostia cohort reproduce`: how results were made, and whether they come out the
// same once more.

#include "cohort/cohort.h"
#include "output/told.h"

#include "ostia/cohort/crate.h"
#include "ostia/cohort/reproduction.h"
#include "ostia/core/child_process.h"
#include "ostia/core/log.h"
#include "ostia/core/parallel.h"
#include "ostia/core/version.h"

#include <algorithm>
#include <array>
#include <chrono>

namespace ostia::app {
namespace fs = std::filesystem;
namespace {

constexpr std::size_t most_files_shown = 20;

/// Each step is a process of its own, as in the workflow.
cohort::ChainRun by_child(const core::TaskContext& task) {
  return [&task](const fs::path& chain, const fs::path& folder, const auto& values) {
    std::vector<std::string> words{
        "run",  chain.string(), "-o",   folder.string(), "--log",
        "json", "--progress",   "none", "--threads",     std::to_string(core::max_threads())};
    for (const auto& [name, value] : values) words.push_back("--set=" + name + "=" + value);
    core::ChildLimits limits;
    limits.memory_bytes = std::uint64_t{1} << 40;
    limits.cpu_time = std::chrono::hours(240);
    const core::ChildResult result = core::run_child(fs::read_symlink("/proc/self/exe"), words, limits, task);
    return result.signal != 0 ? 128 + result.signal : result.exit_code;
  };
}

std::string text_of_files(const std::vector<cohort::ReproducedFile>& files) {
  std::string text;
  std::size_t shown = 0;
  for (const cohort::ReproducedFile& one : files) {
    if (one.verdict != cohort::FileVerdict::differs && one.verdict != cohort::FileVerdict::missing) continue;
    if (++shown <= most_files_shown)
      text += one.scan + ", " + one.stage + ", " + one.file + ": " + name_of(one.verdict) + "\n";
  }
  if (shown > most_files_shown)
    text += "... and " + counted(shown - most_files_shown, "file") + " more (files.csv)\n";
  return text;
}

void say_other_programs(const std::vector<std::string>& programs) {
  for (const std::string& one : programs)
    if (one != core::version())
      core::log_warning("made by Ostia " + one + ", done again by " + core::version() +
                        ": what differs may be the program's");
}

}  // namespace

ExitCode run_cohort_crate(const CohortCrateCommand& c, const core::TaskContext& task) {
  cohort::CrateOptions options;
  if (!c.name.empty()) options.name = c.name;
  options.license = c.license;
  const cohort::CrateResult result = cohort::write_crate(c.cohort, options, task);
  if (result.left_out > 0)
    core::log_warning(counted(result.left_out, "result") +
                      " left out: an older workflow made them, whose records do not say how");
  tell("cohort crate",
       {{"scans", result.scans},
        {"steps", result.steps},
        {"failed", result.failed},
        {"files", result.files},
        {"left_out", result.left_out},
        {"crate", cohort::crate_name}},
       counted(result.steps, "step") + " with " + counted(result.files, "file") + " and " +
           std::to_string(result.failed) + " that failed, of " + counted(result.scans, "scan") + ": " +
           result.file.string(),
       c.json);
  task.set_progress(1.0);
  return result.left_out == 0 ? ExitCode::ok : ExitCode::quality_failed;
}

ExitCode run_cohort_reproduce(const CohortReproduceCommand& c, const core::TaskContext& task) {
  const cohort::Reproduction found =
      cohort::reproduce({c.crate, c.private_folder, c.output, c.only}, by_child(task), task);
  say_other_programs(found.programs);
  using cohort::FileVerdict;
  const std::array<std::size_t, cohort::file_verdict_count> counts{
      found.count(FileVerdict::same), found.count(FileVerdict::but_for_times),
      found.count(FileVerdict::differs), found.count(FileVerdict::missing),
      found.count(FileVerdict::not_compared)};
  ToldJson odd = ToldJson::array();
  for (const cohort::ReproducedFile& one : found.files)
    if (one.verdict == FileVerdict::differs || one.verdict == FileVerdict::missing)
      odd.push_back(
          {{"scan", one.scan}, {"stage", one.stage}, {"file", one.file}, {"verdict", name_of(one.verdict)}});
  tell("cohort reproduce",
       {{"scans", found.scans},
        {"steps", found.steps},
        {"programs", found.programs},
        {"same", counts[0]},
        {"same_but_for_times", counts[1]},
        {"differs", counts[2]},
        {"missing", counts[3]},
        {"not_compared", counts[4]},
        {"files", std::move(odd)}},
       text_of_files(found.files) + counted(found.scans, "scan") + ", " + counted(found.steps, "step") +
           " done again: " + std::to_string(counts[0]) + " files the same, " + std::to_string(counts[1]) +
           " but for times, " + std::to_string(counts[2]) + " differ, " + std::to_string(counts[3]) +
           " missing, " + std::to_string(counts[4]) + " not compared",
       c.json);
  task.set_progress(1.0);
  return found.is_same() ? ExitCode::ok : ExitCode::quality_failed;
}

}  // namespace ostia::app
