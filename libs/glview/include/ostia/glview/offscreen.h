#pragma once
/// \file Drawing without a window and without a display (EGL).

#include "ostia/figure/picture.h"

#include <memory>
#include <string>

namespace ostia::glview {

/// An OpenGL 3.3 context that is current in the thread that made it, with a picture of its own to draw into.
class Offscreen {
 public:
  /// Throws ResourceError that says what is missing, InvalidInput for a size that is not in [16, 8192].
  Offscreen(int width, int height);
  ~Offscreen();
  Offscreen(const Offscreen&) = delete;
  Offscreen& operator=(const Offscreen&) = delete;
  /// Drawing goes into the picture from now on.
  void bind();
  figure::Raster read();
  /// Waits until all is drawn.
  void finish();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Why `Offscreen` cannot be made here; empty where it can.
std::string offscreen_trouble();

}  // namespace ostia::glview
