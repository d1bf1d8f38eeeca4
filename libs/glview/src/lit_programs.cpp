#include "lit_programs.h"

#include "shaders.h"

#include "ostia/figure/color.h"

#include <cmath>
#include <cstdint>
#include <vector>

namespace ostia::glview {
namespace {

constexpr int colors_unit = 4, color_steps = 256;

GlObject scale_texture(SurfaceValue value) {
  std::vector<std::uint8_t> bytes;
  for (int i = 0; i < color_steps; ++i) {
    const figure::Color c = color(value, i / (color_steps - 1.0));
    for (const double part : {c.r, c.g, c.b})
      bytes.push_back(static_cast<std::uint8_t>(std::lround(255.0 * part)));
  }
  GlObject texture = new_texture();
  glActiveTexture(GL_TEXTURE0 + colors_unit);
  glBindTexture(GL_TEXTURE_1D, texture.name());
  glTexImage1D(GL_TEXTURE_1D, 0, GL_RGB8, color_steps, 0, GL_RGB, GL_UNSIGNED_BYTE, bytes.data());
  glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MIN_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_1D, GL_TEXTURE_WRAP_S, GL_CLAMP_TO_EDGE);
  return texture;
}

/// As directions, since the eye is far away.
void set_lights(const GlObject& program, const Camera& camera) {
  const Vec3 to_eye = camera.towards();
  const Vec3 key = (to_eye + 0.9 * camera.up() - 0.7 * camera.right()).normalized();
  set_uniform(program, "to_eye", to_eye);
  set_uniform(program, "key", key);
  set_uniform(program, "half_way", Vec3((key + to_eye).normalized()));
  set_uniform(program, "up", camera.up());
}

}  // namespace

LitPrograms::LitPrograms()
    : sequential_(scale_texture(SurfaceValue::displacement)),
      diverging_(scale_texture(SurfaceValue::stretch)) {}

const GlObject& LitPrograms::of(bool valued, bool cut_end) {
  GlObject& program = programs_[(valued ? 2U : 0U) + (cut_end ? 1U : 0U)];
  if (program.name() == 0)
    program = new_program(surface_vertex_shader(valued), lit_fragment_shader(valued, cut_end));
  return program;
}

void LitPrograms::set_look(const GlObject& program, bool valued, const Camera& camera,
                           const SceneLook& look) const {
  set_lights(program, camera);
  if (valued) {
    glActiveTexture(GL_TEXTURE0 + colors_unit);
    glBindTexture(GL_TEXTURE_1D, (is_signed(look.value) ? diverging_ : sequential_).name());
    set_uniform(program, "colors", colors_unit);
    set_uniform(program, "shaded", look.shaded ? 1 : 0);
    return;
  }
  const figure::Color plain =
      look.value == SurfaceValue::none ? figure::colors::lumen : figure::theme(figure::Look::dark).muted;
  set_uniform(program, "plain", static_cast<float>(plain.r), static_cast<float>(plain.g),
              static_cast<float>(plain.b));
}

}  // namespace ostia::glview
