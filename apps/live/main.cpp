// The live viewer.

#include "live_heart.h"
#include "options.h"
#include "pictures.h"
#include "tree_window.h"
#include "window.h"

#include "ostia/core/error.h"
#include "ostia/core/program.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

void print(const std::vector<std::string>& warnings) {
  for (const std::string& warning : warnings) std::fprintf(stderr, "ostia-live: %s\n", warning.c_str());
}

int run_tree(const ostia::live::Options& options, const ostia::core::TaskContext& task) {
  if (!options.screenshot.empty() || !options.video.empty()) {
    const ostia::live::TreeInput input = ostia::live::read_tree(options, task);
    print(input.warnings);
    ostia::live::write_tree_pictures(input, options, task);
    return 0;
  }
  ostia::live::show_tree(
      options, [](const ostia::live::TreeInput& input) { print(input.warnings); }, task);
  if (const int signal = ostia::core::caught_signal()) return 128 + signal;
  return 0;
}

int run_heart(const ostia::live::Options& options, const ostia::core::TaskContext& task) {
  bool ecg_failed = false;
  const auto told = [&](const ostia::live::LiveInput& input) {
    print(input.warnings);
    ecg_failed = input.ecg_failed;
  };
  if (options.screenshot.empty() && options.video.empty()) {
    ostia::live::show_window(options, told, task);
    if (const int signal = ostia::core::caught_signal()) return 128 + signal;
  } else {
    const ostia::live::LiveHeart heart = ostia::live::read_heart(options, task);
    told(heart.input);
    ostia::live::write_pictures(heart, options, task);
  }
  return static_cast<int>(ecg_failed ? ostia::ExitCode::quality_failed : ostia::ExitCode::ok);
}

int run(const std::vector<std::string>& arguments, const ostia::core::TaskContext& task) {
  const auto options = ostia::live::options_of(arguments);
  if (!options) return 0;
  return options->tree ? run_tree(*options, task) : run_heart(*options, task);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::core::run_program("ostia-live", [&](const ostia::core::TaskContext& task) {
    return run(std::vector<std::string>(argv + 1, argv + argc), task);
  });
}
