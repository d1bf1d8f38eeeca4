// The live viewer.

#include "live_input.h"
#include "options.h"
#include "pictures.h"
#include "window.h"

#include "ostia/core/error.h"
#include "ostia/core/program.h"

#include <cstdio>
#include <string>
#include <vector>

namespace {

int run(const std::vector<std::string>& arguments, const ostia::core::TaskContext& task) {
  const auto options = ostia::live::options_of(arguments);
  if (!options) return 0;
  const ostia::live::LiveInput input = ostia::live::read_input(*options);
  for (const std::string& warning : input.warnings) std::fprintf(stderr, "ostia-live: %s\n", warning.c_str());
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
