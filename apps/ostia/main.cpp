// The command line program.

#include "cli.h"

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

/// A refusal names the file it is about, so it is shown to the person at the terminal as it is. The JSON log
/// is made to be kept and holds no path.
int fail(const std::string& message, int code) {
  if (ostia::core::log_format() == ostia::core::LogFormat::json) {
    ostia::core::log_error(message);
  } else {
    std::fprintf(stderr, "ostia: %s\n", message.c_str());
  }
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is reported by the write
  try {
    return ostia::app::run(std::vector<std::string>(argv + 1, argv + argc), job);
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
