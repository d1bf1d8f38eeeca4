#pragma once
/// \file The window.

#include "live_input.h"

#include "ostia/core/task_context.h"

namespace ostia::live {

/// Until it is closed, its time is up or `task` is cancelled. Throws ResourceError where no window with
/// OpenGL 3.3 can be had.
void show_window(const LiveInput& input, const Options& options, const core::TaskContext& task);

}  // namespace ostia::live
