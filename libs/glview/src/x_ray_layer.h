#pragma once
/// \file The ways of rays through vessels, summed per pixel, and the picture of them.

#include "gl_objects.h"

#include "ostia/glview/beating_scene.h"

namespace ostia::glview {

/// 32-bit sums: ways are differences of distances.
class XRayLayer {
 public:
  XRayLayer();
  /// Between these, what is drawn is added up.
  void begin(int width, int height);
  void end();
  /// Fills the viewport of the framebuffer that was bound at `begin`.
  void show(const Viewport& viewport, double absorption_per_mm);

 private:
  GlObject program_, framebuffer_, sums_;
  int width_ = 0, height_ = 0;
  GLint outer_ = 0;
};

}  // namespace ostia::glview
