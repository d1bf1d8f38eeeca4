#pragma once
/// \file The window.

#include "live_heart.h"

#include "ostia/core/task_context.h"

#include <functional>

namespace ostia::live {

/// Opens the window at once, shows what is being prepared and then the heart, until it is closed, its time is
/// up or `task` is cancelled. `told` gets the input when it has been read. Throws as `read_heart`, and
/// ResourceError where no window with OpenGL 3.3 can be had.
void show_window(const Options& options, const std::function<void(const LiveInput&)>& told,
                 const core::TaskContext& task);

}  // namespace ostia::live
