#pragma once
/// \file Whether a window for pictures in three dimensions can be opened at all.

#include <optional>
#include <string>

namespace ostia::view {

/// Why there is no OpenGL 3.2, in English.
struct OpenGlTrouble {
  std::string reason;        ///< a sentence
  std::string way_out;       ///< a sentence: what is needed, and how to get it
  bool has_display = false;  ///< an X display answered: a window without OpenGL can be shown there
  std::string text() const { return reason + " " + way_out; }
};

/// Why no OpenGL 3.2 context can be made on the display; nothing where one can. Asked in a child process,
/// since drivers may end the process that asks, and given up after ten seconds. To be called once at the
/// start, before a window is shown and threads are many.
std::optional<OpenGlTrouble> check_opengl();

}  // namespace ostia::view
