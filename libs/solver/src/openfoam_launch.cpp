#include "ostia/solver/openfoam_launch.h"

#include "ostia/core/child_process.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <fstream>
#include <limits>
#include <sstream>
#include <stop_token>
#include <thread>
#include <vector>

namespace ostia::solver {
namespace fs = std::filesystem;
namespace {

constexpr std::streamoff read_bytes = 64 << 10;  // of a log's end: tens of iterations at least
constexpr std::size_t lines_told = 8;
constexpr auto look_every = std::chrono::milliseconds(200);

/// Runs the script $1. Where Ostia dies, only its own child dies with it; so a watcher beside the script ends
/// the whole group then. It keeps no standard error, of whose end Ostia waits.
constexpr const char* watched_script =
    "(while kill -0 \"$PPID\"; do sleep 1; done; kill -KILL -$$) > /dev/null 2>&1 &\n"
    "sh \"$1\"\nended=$?\nkill $!\nexit $ended\n";

/// Arguments of `env` that run a script so. They bring the variables of other installations than Debian's,
/// which a child is not given otherwise.
std::vector<std::string> watched(const fs::path& script) {
  std::vector<std::string> words;
  for (char** variable = environ; *variable != nullptr; ++variable)
    for (const char* begin : {"WM_", "FOAM_", "MPI_", "OPAL_", "OMPI_", "HOME="})
      if (std::string_view(*variable).starts_with(begin)) words.emplace_back(*variable);
  words.insert(words.end(), {"/bin/sh", "-c", watched_script, "sh", script.string()});
  return words;
}

std::optional<double> number_at(std::string_view text) {
  text.remove_prefix(std::min(text.find_first_not_of(' '), text.size()));
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || !std::isfinite(value)) return std::nullopt;
  return value;
}

/// The value of the first line `key value;`, blanks aside; empty where there is none.
std::string entry(const std::string& text, std::string_view key) {
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string name, value;
    if (!(words >> name >> value) || name != key || value.back() != ';') continue;
    value.pop_back();
    return value;
  }
  return {};
}

std::string after(const std::string& text, std::string_view word) {
  const std::size_t at = text.find(word);
  return at == std::string::npos ? std::string() : text.substr(at + word.size());
}

std::string end_of_log(const fs::path& log) {
  std::ifstream file(log, std::ios::binary | std::ios::ate);
  if (!file) return {};
  const std::streamoff size = file.tellg(), from = std::max<std::streamoff>(0, size - read_bytes);
  file.seekg(from);
  std::string text(static_cast<std::size_t>(size - from), '\0');
  file.read(text.data(), static_cast<std::streamsize>(text.size()));
  text.resize(static_cast<std::size_t>(std::max<std::streamsize>(0, file.gcount())));
  return text;
}

std::string stage_of(const OpenfoamProgress& progress, const OpenfoamRunPlan& plan) {
  std::array<char, 80> text{};
  if (!plan.steady())
    std::snprintf(text.data(), text.size(), "time, s: %.3g / %.3g", progress.time, plan.end_time);
  else if (progress.residual)
    std::snprintf(text.data(), text.size(), "iteration, residual: %.0f, %.0e", progress.time,
                  *progress.residual);
  else
    return "checking the mesh";
  return text.data();
}

/// Reports what the log says until it is told to stop.
void watch(const std::stop_token& stop, const fs::path& log, const OpenfoamRunPlan& plan,
           const core::TaskContext& task) {
  while (!stop.stop_requested()) {
    const OpenfoamProgress now = progress_of_log(end_of_log(log));
    task.set_stage(stage_of(now, plan));
    task.set_progress(share_done(now, plan));
    std::this_thread::sleep_for(look_every);
  }
}

/// The log that was written last, which is that of the program that failed.
fs::path last_log(const fs::path& folder) {
  fs::path last;
  for (const auto& file : fs::directory_iterator(folder)) {
    if (file.path().filename().string().rfind("log.", 0) != 0) continue;
    if (last.empty() || file.last_write_time() > fs::last_write_time(last)) last = file.path();
  }
  return last;
}

std::string last_lines(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream all(text);
  for (std::string line; std::getline(all, line);)
    if (line.find_first_not_of(" \t\r") != std::string::npos) lines.push_back(line.substr(0, 200));
  std::string told;
  for (std::size_t i = lines.size() - std::min(lines.size(), lines_told); i < lines.size(); ++i)
    told += "\n" + lines[i];
  return told;
}

/// Told to stop by somebody, which says nothing of the case.
bool ended_from_outside(const core::ChildResult& child) {
  constexpr int of_shell = 128;  // what a shell adds to the number of the signal that ended a program
  const int signal = child.signal != 0 ? child.signal : child.exit_code - of_shell;
  return signal == SIGTERM || signal == SIGINT || signal == SIGHUP;
}

[[noreturn]] void refuse_failed(const fs::path& folder, const core::ChildResult& child) {
  if (ended_from_outside(child))
    throw ResourceError("the run of " + folder.string() + " was ended from outside (Allrun " +
                        child.describe() + "); run it again");
  const std::string what = "the run of " + folder.string() + " failed: Allrun " + child.describe();
  const fs::path log = last_log(folder);
  const std::string told = last_lines(child.standard_error);
  if (log.empty()) throw NumericalError(what + told);
  throw NumericalError(what + (told.empty() ? ". " : told + "\n") + log.filename().string() +
                       " ends with:" + last_lines(end_of_log(log)));
}

}  // namespace

OpenfoamRunPlan openfoam_run_plan(const fs::path& case_folder) {
  const std::string control = core::read_file(case_folder / "system" / "controlDict");
  OpenfoamRunPlan plan;
  plan.program = entry(control, "application");
  const auto end = number_at(entry(control, "endTime"));
  constexpr std::array<std::string_view, 3> known{"simpleFoam", "pimpleFoam", "pisoFoam"};
  if (std::ranges::find(known, plan.program) == known.end() || !end || *end <= 0.0 ||
      !fs::exists(case_folder / "Allrun"))
    throw InvalidInput(case_folder.string() +
                       " holds no case of simpleFoam or pimpleFoam with a script Allrun; write one with "
                       "\"ostia case\" or from the window");
  plan.end_time = *end;
  const std::string controls = core::read_file(case_folder / "system" / "fvSolution");
  const auto tolerance = number_at(entry(after(controls, "residualControl"), "p"));
  if (tolerance && *tolerance > 0.0 && *tolerance < 1.0) plan.tolerance = *tolerance;
  return plan;
}

OpenfoamProgress progress_of_log(std::string_view log_end) {
  constexpr std::string_view time_word = "\nTime = ", residual_word = "Initial residual = ";
  OpenfoamProgress progress;
  progress.converged = log_end.find("SIMPLE solution converged") != std::string_view::npos;
  for (std::size_t at = log_end.find(time_word); at != std::string_view::npos;) {
    // What stands between two times; the last one may still grow.
    const std::size_t next = log_end.find(time_word, at + 1);
    const std::string_view block = log_end.substr(at, next == std::string_view::npos ? next : next - at);
    if (const auto time = number_at(block.substr(time_word.size()))) progress.time = *time;
    std::optional<double> largest;
    for (std::size_t r = block.find(residual_word); r != std::string_view::npos;
         r = block.find(residual_word, r + 1))
      if (const auto residual = number_at(block.substr(r + residual_word.size())))
        largest = std::max(largest.value_or(0.0), *residual);
    if (largest && block.find("ExecutionTime") != std::string_view::npos) progress.residual = largest;
    at = next;
  }
  return progress;
}

double share_done(const OpenfoamProgress& progress, const OpenfoamRunPlan& plan) {
  const double share = std::clamp(progress.time / plan.end_time, 0.0, 1.0);
  if (!plan.steady() || !progress.residual || *progress.residual <= 0.0) return share;
  return std::max(share, std::clamp(std::log(*progress.residual) / std::log(plan.tolerance), 0.0, 1.0));
}

bool openfoam_can_work_in(const fs::path& folder) {
  return fs::absolute(folder).string().find_first_of(" \t\n\r\"'") == std::string::npos;
}

OpenfoamProgress run_openfoam_case(const fs::path& case_folder, const core::TaskContext& task) {
  const OpenfoamRunPlan plan = openfoam_run_plan(case_folder);
  const fs::path script = fs::absolute(case_folder / "Allrun");
  if (!openfoam_can_work_in(case_folder))
    throw InvalidInput("OpenFOAM cannot work in " + fs::absolute(case_folder).string() +
                       ": the path has blanks or quotation marks; move the case");
  if (!core::program_on_path(plan.program))
    throw IoError(plan.program +
                  " is not on the PATH. Install OpenFOAM (Debian: apt install openfoam), or run " +
                  script.string() + " where it is installed");
  const fs::path log = case_folder / ("log." + plan.program);
  std::error_code ignored;
  fs::remove(log, ignored);  // of an earlier run, which would be taken for this one's
  core::ChildLimits limits;  // OpenFOAM may take what there is
  limits.memory_bytes = limits.output_bytes = std::numeric_limits<std::uint64_t>::max();
  limits.cpu_time = std::chrono::hours(24 * 365);
  core::ChildResult child;
  {
    const std::jthread watcher([&](const std::stop_token& stop) { watch(stop, log, plan, task); });
    child = core::run_child("/usr/bin/env", watched(script), limits, task);
  }
  if (!child.ok()) refuse_failed(case_folder, child);
  task.set_progress(1.0);
  return progress_of_log(end_of_log(log));
}

}  // namespace ostia::solver
