#pragma once
/// \file What the main function of each program does the same.

#include "ostia/core/task_context.h"

#include <functional>

namespace ostia::core {

/// Runs `body` and returns the program's exit code: what `body` returns, an Error's own, that for want of
/// memory, or that for a fault of the program, each refusal in one line on stderr ("name: ...") or in the
/// JSON log, where that is on (then without paths). SIGINT and SIGTERM cancel the task; a Cancelled then ends
/// it with 128 + the signal's number, and a second signal ends it at once. To be called once.
int run_program(const char* name, const std::function<int(const TaskContext& task)>& body);

/// The signal that has asked the running program to end; 0: none.
int caught_signal();

}  // namespace ostia::core
