#pragma once
/// \file The window.

#include "live_input.h"

#include <csignal>

namespace ostia::live {

/// Until it is closed, its time is up or `asked_to_end` is set. Throws ResourceError where no window with
/// OpenGL 3.3 can be had.
void show_window(const LiveInput& input, const Options& options,
                 const volatile std::sig_atomic_t& asked_to_end);

}  // namespace ostia::live
