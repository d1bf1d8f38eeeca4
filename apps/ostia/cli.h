#pragma once
/// \file From the command line to a command.

#include <string>
#include <vector>

#include "ostia/core/task_context.h"

namespace ostia::app {

/// Parses the arguments (without the program's name) and runs the command. Returns the exit code.
int run(const std::vector<std::string>& arguments, const core::TaskContext& job);

}  // namespace ostia::app
