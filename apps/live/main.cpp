// The live viewer.

#include "live_input.h"
#include "options.h"
#include "pictures.h"
#include "window.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"
#include "ostia/core/task_context.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>
#include <vector>

namespace {

const ostia::core::TaskContext job;
volatile std::sig_atomic_t caught = 0;

void on_signal(int number) {
  caught = number;
  job.cancel();
  std::signal(number, SIG_DFL);  // the second time it ends the program at once
}

int fail(const std::string& message, int code) {
  std::fprintf(stderr, "ostia-live: %s\n", message.c_str());
  return code;
}

int run(const std::vector<std::string>& arguments) {
  const auto options = ostia::live::options_of(arguments);
  if (!options) return 0;
  const ostia::live::LiveInput input = ostia::live::read_input(*options);
  for (const std::string& warning : input.warnings) std::fprintf(stderr, "ostia-live: %s\n", warning.c_str());
  job.throw_if_cancelled();
  if (options->screenshot.empty() && options->video.empty()) {
    ostia::live::show_window(input, *options, caught);
    if (caught != 0) return 128 + static_cast<int>(caught);
  } else {
    ostia::live::write_pictures(input, *options, job);
  }
  return static_cast<int>(input.ecg_failed ? ostia::ExitCode::quality_failed : ostia::ExitCode::ok);
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is reported by the write
  try {
    return run(std::vector<std::string>(argv + 1, argv + argc));
  } catch (const ostia::Cancelled&) {
    return fail("cancelled; nothing was written", 128 + (caught ? static_cast<int>(caught) : SIGINT));
  } catch (const ostia::Error& error) {
    return fail(error.what(), static_cast<int>(error.exit_code()));
  } catch (const std::bad_alloc&) {
    return fail("out of memory", static_cast<int>(ostia::ExitCode::resources));
  } catch (const std::exception& error) {
    return fail(std::string("a fault of the program: ") + error.what(),
                static_cast<int>(ostia::ExitCode::internal));
  }
}
