// What is asked of OpenGL beside the scenes.

#include "ostia/glview/beating_scene.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <cstddef>

namespace ostia::glview {

bool has_opengl_33() {
  return epoxy_is_desktop_gl() && epoxy_gl_version() >= 33;
}

std::string renderer_name() {
  const GLubyte* name = glGetString(GL_RENDERER);
  return name == nullptr ? "no OpenGL" : reinterpret_cast<const char*>(name);
}

void fill(const Viewport& viewport, const figure::Color& color) {
  glEnable(GL_SCISSOR_TEST);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glClearColor(static_cast<float>(color.r), static_cast<float>(color.g), static_cast<float>(color.b), 1.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

void begin_part(const Viewport& viewport, const figure::Color& color) {
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  fill(viewport, color);
  glEnable(GL_SCISSOR_TEST);
  glScissor(viewport.x, viewport.y, viewport.width, viewport.height);
  glDepthMask(GL_TRUE);
  glClear(GL_DEPTH_BUFFER_BIT);
  glDisable(GL_SCISSOR_TEST);
}

figure::Raster read_pixels(int width, int height) {
  figure::Raster raster{width, height, {}};
  const std::size_t row = 4 * static_cast<std::size_t>(width);
  raster.rgba.resize(row * static_cast<std::size_t>(height));
  glPixelStorei(GL_PACK_ALIGNMENT, 1);
  glReadPixels(0, 0, width, height, GL_RGBA, GL_UNSIGNED_BYTE, raster.rgba.data());
  for (int y = 0; y < height / 2; ++y)
    std::swap_ranges(raster.rgba.begin() + static_cast<std::ptrdiff_t>(row) * y,
                     raster.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (y + 1),
                     raster.rgba.begin() + static_cast<std::ptrdiff_t>(row) * (height - 1 - y));
  for (std::size_t i = 3; i < raster.rgba.size(); i += 4) raster.rgba[i] = 255;
  return raster;
}

}  // namespace ostia::glview
