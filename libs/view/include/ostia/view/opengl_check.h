#pragma once
/// \file Whether a window for pictures in three dimensions can be opened at all.

#include <optional>
#include <string>

namespace ostia::view {

/// Why no OpenGL 3.2 context can be made on the display, in one sentence with the way out; nothing where one
/// can. Asked in a child process, since drivers may end the process that asks, and given up after ten
/// seconds. To be called once at the start, before a window is shown and threads are many.
std::optional<std::string> check_opengl();

}  // namespace ostia::view
