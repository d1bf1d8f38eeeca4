// The live viewer.

#include "live_input.h"
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
  const ostia::live::TreeInput input = ostia::live::read_tree(options, task);
  print(input.warnings);
  if (!options.screenshot.empty() || !options.video.empty()) {
    ostia::live::write_tree_pictures(input, options, task);
    return 0;
  }
  ostia::live::show_tree(input, options, task);
  if (const int signal = ostia::core::caught_signal()) return 128 + signal;
  return 0;
}

int run(const std::vector<std::string>& arguments, const ostia::core::TaskContext& task) {
  const auto options = ostia::live::options_of(arguments);
  if (!options) return 0;
  if (options->tree) return run_tree(*options, task);
  const ostia::live::LiveInput input = ostia::live::read_input(*options);
  print(input.warnings);
  task.throw_if_cancelled();
  if (options->screenshot.empty() && options->video.empty()) {
    ostia::live::show_window(input, *options, task);
    if (const int signal = ostia::core::caught_signal()) return 128 + signal;
  } else {
    ostia::live::write_pictures(input, *options, task);
  }
  return static_cast<int>(input.ecg_failed ? ostia::ExitCode::quality_failed : ostia::ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
  return ostia::core::run_program("ostia-live", [&](const ostia::core::TaskContext& task) {
    return run(std::vector<std::string>(argv + 1, argv + argc), task);
  });
}
