#pragma once
/// \file From the command line to a command.

#include "ostia/core/task_context.h"

#include <string>
#include <vector>

namespace ostia::app {

/// Parses the arguments (without the program's name) and runs the command. Returns the exit code.
int run(const std::vector<std::string>& arguments, const core::TaskContext& job);

/// The same for a command that is a part of another one: what the parser refuses is thrown, as UsageError
/// with its reason, instead of printed.
int run_within(const std::vector<std::string>& arguments, const core::TaskContext& job);

}  // namespace ostia::app
