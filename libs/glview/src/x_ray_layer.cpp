#include "x_ray_layer.h"

#include "shaders.h"

#include "ostia/core/error.h"

namespace ostia::glview {

XRayLayer::XRayLayer()
    : program_(new_program(whole_vertex_shader(), absorption_fragment_shader())),
      framebuffer_(new_framebuffer()),
      sums_(new_texture()) {}

void XRayLayer::begin(int width, int height) {
  glGetIntegerv(GL_DRAW_FRAMEBUFFER_BINDING, &outer_);
  glBindFramebuffer(GL_FRAMEBUFFER, framebuffer_.name());
  if (width != width_ || height != height_) {
    glActiveTexture(GL_TEXTURE0);
    glBindTexture(GL_TEXTURE_2D, sums_.name());
    glTexImage2D(GL_TEXTURE_2D, 0, GL_R32F, width, height, 0, GL_RED, GL_FLOAT, nullptr);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_NEAREST);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
    glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_CLAMP_TO_EDGE);
    glFramebufferTexture2D(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_TEXTURE_2D, sums_.name(), 0);
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE) {
      glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer_));
      throw ResourceError("OpenGL has no memory for a projection of " + std::to_string(width) + " x " +
                          std::to_string(height) + " pixels");
    }
    width_ = width;
    height_ = height;
  }
  glViewport(0, 0, width, height);
  glDisable(GL_SCISSOR_TEST);
  glClearColor(0.0F, 0.0F, 0.0F, 0.0F);
  glClear(GL_COLOR_BUFFER_BIT);
  glDisable(GL_DEPTH_TEST);
  glEnable(GL_BLEND);
  glBlendEquation(GL_FUNC_ADD);
  glBlendFunc(GL_ONE, GL_ONE);
}

void XRayLayer::end() {
  glDisable(GL_BLEND);
  glBindFramebuffer(GL_FRAMEBUFFER, static_cast<GLuint>(outer_));
}

void XRayLayer::show(const Viewport& viewport, double absorption_per_mm) {
  glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
  glUseProgram(program_.name());
  glActiveTexture(GL_TEXTURE0);
  glBindTexture(GL_TEXTURE_2D, sums_.name());
  set_uniform(program_, "ways", 0);
  set_uniform(program_, "per_mm", static_cast<float>(absorption_per_mm));
  glDrawArrays(GL_TRIANGLES, 0, 3);
}

}  // namespace ostia::glview
