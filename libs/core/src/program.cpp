#include "ostia/core/program.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"

#include <csignal>
#include <cstdio>
#include <exception>
#include <new>
#include <string>

namespace ostia::core {
namespace {

const TaskContext job;
volatile std::sig_atomic_t caught = 0;

void on_signal(int number) {
  caught = number;
  job.cancel();
  std::signal(number, SIG_DFL);  // the second time it ends the program at once
}

/// A refusal names the file it is about, so it is shown to the person at the terminal as it is. The JSON log
/// is made to be kept and holds no path.
int fail(const char* name, const std::string& message, int code) {
  if (log_format() == LogFormat::json) {
    log_error(message);
  } else {
    std::fprintf(stderr, "%s: %s\n", name, message.c_str());
  }
  return code;
}

}  // namespace

int run_program(const char* name, const std::function<int(const TaskContext&)>& body) {
  std::signal(SIGINT, on_signal);
  std::signal(SIGTERM, on_signal);
  std::signal(SIGPIPE, SIG_IGN);
  std::signal(SIGXFSZ, SIG_IGN);  // a file that grows too large is reported by the write
  try {
    return body(job);
  } catch (const Cancelled&) {
    return fail(name, "cancelled; nothing was written", 128 + (caught ? static_cast<int>(caught) : SIGINT));
  } catch (const Error& error) {
    return fail(name, error.what(), static_cast<int>(error.exit_code()));
  } catch (const std::bad_alloc&) {
    return fail(name, "out of memory", static_cast<int>(ExitCode::resources));
  } catch (const std::exception& error) {
    return fail(name, std::string("internal error: ") + error.what(), static_cast<int>(ExitCode::internal));
  }
}

int caught_signal() {
  return static_cast<int>(caught);
}

}  // namespace ostia::core
