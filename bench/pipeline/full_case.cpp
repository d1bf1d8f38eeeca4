#include "full_case.h"

#include "dataset.h"
#include "shared_data.h"

#include "ostia/core/error.h"

#include <fcntl.h>
#include <spawn.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <fstream>
#include <thread>

namespace ostia::bench {
namespace {

/// Linux counts a started program's peak from its parent's on (ru_maxrss); this one begins anew.
double peak_mb_of(pid_t process) {
  std::ifstream status("/proc/" + std::to_string(process) + "/status");
  for (std::string line; std::getline(status, line);)
    if (line.rfind("VmHWM:", 0) == 0) return std::stod(line.substr(6)) / 1024.0;
  return 0.0;
}

double seconds_of(const timeval& time) {
  return static_cast<double>(time.tv_sec) + 1e-6 * static_cast<double>(time.tv_usec);
}

std::filesystem::path made_case() {
  const char* kept = std::getenv("OSTIA_BENCH_CASE");
  const std::filesystem::path suite =
      kept != nullptr ? std::filesystem::path(kept) : ostia::testing::temporary_folder("bench") / "full";
  const Finished made = run_ostia(
      {"phantom", "-o", suite.string(), "--preset", "full", "--formats", "nrrd,dicom", "--no-report"});
  if (made.code != 0) throw InvalidInput("the full case could not be made in " + suite.string());
  return suite / "dataset00";
}

}  // namespace

const phantom::CasePlan& full_plan() {
  static const phantom::CasePlan plan = phantom::plan_case({});
  return plan;
}

const std::filesystem::path& full_case() {
  static const std::filesystem::path folder = made_case();
  return folder;
}

const imaging::ImageVolume& full_image() {
  static const imaging::ImageVolume image = image_of(full_case());
  return image;
}

Finished run_ostia(const std::vector<std::string>& arguments) {
  const std::filesystem::path output = ostia::testing::temporary_folder("run") / "out";
  std::vector<std::string> words{OSTIA_PROGRAM};
  words.insert(words.end(), arguments.begin(), arguments.end());
  words.insert(words.end(), {"--progress", "none"});
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  posix_spawn_file_actions_t files;
  posix_spawn_file_actions_init(&files);
  posix_spawn_file_actions_addopen(&files, STDOUT_FILENO, output.c_str(), O_WRONLY | O_CREAT, 0600);
  const auto start = std::chrono::steady_clock::now();
  pid_t process = 0;
  const int started = ::posix_spawn(&process, argv.front(), &files, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&files);
  if (started != 0) throw InvalidInput(std::string("cannot start ") + OSTIA_PROGRAM);
  Finished finished;
  int status = 0;
  rusage usage{};
  while (::wait4(process, &status, WNOHANG, &usage) == 0) {
    finished.peak_mb = std::max(finished.peak_mb, peak_mb_of(process));
    std::this_thread::sleep_for(std::chrono::milliseconds(2));
  }
  finished.seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  finished.cpu_seconds = seconds_of(usage.ru_utime) + seconds_of(usage.ru_stime);
  finished.code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  std::ifstream said(output);
  finished.said.assign(std::istreambuf_iterator<char>(said), {});
  return finished;
}

}  // namespace ostia::bench
