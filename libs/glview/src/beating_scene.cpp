#include "ostia/glview/beating_scene.h"

#include "gl_objects.h"
#include "shaders.h"
#include "x_ray_layer.h"

#include "ostia/core/error.h"
#include "ostia/figure/color.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace ostia::glview {
namespace {

constexpr int control_unit = 1, rates_unit = 2, bending_unit = 3, colors_unit = 4;
constexpr int color_steps = 256;

std::vector<float> four_floats_each(const std::vector<Vec3>& points) {
  std::vector<float> values(4 * points.size(), 0.0F);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      values[4 * i + axis] = static_cast<float>(points[i][static_cast<Eigen::Index>(axis)]);
  return values;
}

void set_uniform_of(const GlObject& program, const char* name, const Vec3& v) {
  set_uniform(program, name, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

void add_attribute(GLuint index, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, sizeof(ShownVertex),
                        reinterpret_cast<const void*>(offset));
}

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

}  // namespace

struct BeatingScene::Impl {
  motion::MovingCage cage;
  geometry::CageGrid grid;
  std::size_t vertices, open_indices, indices;
  bool closed;
  GlObject lit = new_program(surface_vertex_shader(), lit_fragment_shader());
  GlObject depth = new_program(surface_vertex_shader(), depth_fragment_shader());
  GlObject backdrop = new_program(whole_vertex_shader(), backdrop_fragment_shader());
  GlObject vertex_array = new_vertex_array(), empty_array = new_vertex_array();
  GlObject vertex_buffer = new_buffer(), index_buffer = new_buffer();
  BufferTexture control{GL_RGBA32F}, rates{GL_RGBA32F}, bending{GL_R32F};
  GlObject sequential = scale_texture(SurfaceValue::displacement),
           diverging = scale_texture(SurfaceValue::stretch);
  XRayLayer x_ray;
  int bending_phases = 0;
  double phase = 0.0, interval_s = 1.0;
  bool rates_are_of_phase = false;

  Impl(const ShownSurface& surface, const motion::MovingCage& of)
      : cage(of),
        grid(surface.grid),
        vertices(surface.vertices.size()),
        open_indices(3 * surface.open_triangles),
        indices(3 * surface.triangles.size()),
        closed(surface.closed) {
    glBindVertexArray(vertex_array.name());
    glBindBuffer(GL_ARRAY_BUFFER, vertex_buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(vertices * sizeof(ShownVertex)),
                 surface.vertices.data(), GL_STATIC_DRAW);
    glEnableVertexAttribArray(0);
    glVertexAttribIPointer(0, 1, GL_INT, sizeof(ShownVertex), nullptr);
    add_attribute(1, offsetof(ShownVertex, local));
    add_attribute(2, offsetof(ShownVertex, rest));
    add_attribute(3, offsetof(ShownVertex, normal));
    add_attribute(4, offsetof(ShownVertex, along));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices * sizeof(std::int32_t)),
                 surface.triangles.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    const float nothing[4] = {};
    rates.fill(nothing, 4);
    bending.fill(nothing, 1);
    check("the surface goes to the graphics card");
  }

  void use(const GlObject& program, const Camera& camera, const SceneLook& look, double aspect) {
    glUseProgram(program.name());
    control.bind(control_unit);
    rates.bind(rates_unit);
    bending.bind(bending_unit);
    set_uniform(program, "control_points", control_unit);
    set_uniform(program, "control_rates", rates_unit);
    set_uniform(program, "bending", bending_unit);
    set_uniform(program, "side", grid.points_a_side());
    set_uniform_of(program, "cell_mm", grid.cell_mm);
    set_uniform_of(program, "low", grid.origin);
    set_uniform_of(program, "high", grid.origin + grid.cells * grid.cell_mm);
    const Eigen::Matrix4f matrix = camera.clip_of_world(aspect);
    glUniformMatrix4fv(glGetUniformLocation(program.name(), "clip_of_world"), 1, GL_FALSE, matrix.data());
    set_uniform_of(program, "eye", camera.centre_of_projection());
    const bool bends = look.value == SurfaceValue::bending;
    set_uniform(program, "value_kind", bends && bending_phases == 0 ? 0 : static_cast<int>(look.value));
    glUniform2f(glGetUniformLocation(program.name(), "value_range"), static_cast<float>(look.range.low),
                static_cast<float>(look.range.high));
    set_uniform(program, "interval_s", static_cast<float>(interval_s));
    if (bends && bending_phases > 0) set_bending_phase(program);
  }

  void update_rates(const SceneLook& look) {
    if (look.value != SurfaceValue::velocity || rates_are_of_phase) return;
    const std::vector<float> floats = four_floats_each(cage.rate(phase));
    rates.fill(floats.data(), floats.size());
    rates_are_of_phase = true;
  }

  /// What the vertex shader gives for each vertex, by transform feedback.
  template <class Value>
  std::vector<Value> captured(const char* name, const SceneLook& look) {
    const GlObject program = new_program(surface_vertex_shader(), lit_fragment_shader(), name);
    const GlObject buffer = new_buffer();
    std::vector<Value> result(vertices);
    const auto bytes = static_cast<GLsizeiptr>(result.size() * sizeof(Value));
    glBindBuffer(GL_TRANSFORM_FEEDBACK_BUFFER, buffer.name());
    glBufferData(GL_TRANSFORM_FEEDBACK_BUFFER, bytes, nullptr, GL_STATIC_READ);
    glBindBufferBase(GL_TRANSFORM_FEEDBACK_BUFFER, 0, buffer.name());
    use(program, Camera{}, look, 1.0);
    glEnable(GL_RASTERIZER_DISCARD);
    glBindVertexArray(vertex_array.name());
    glBeginTransformFeedback(GL_POINTS);
    glDrawArrays(GL_POINTS, 0, static_cast<GLsizei>(result.size()));
    glEndTransformFeedback();
    glDisable(GL_RASTERIZER_DISCARD);
    glBindVertexArray(0);
    glGetBufferSubData(GL_TRANSFORM_FEEDBACK_BUFFER, 0, bytes, result.data());
    check("values are read from the graphics card");
    return result;
  }

  void set_bending_phase(const GlObject& program) const {
    const double at = (phase - std::floor(phase)) * bending_phases;
    const int from = static_cast<int>(at) % bending_phases;
    const auto block = static_cast<int>(vertices);
    set_uniform(program, "bending_from", from * block);
    set_uniform(program, "bending_to", (from + 1) % bending_phases * block);
    set_uniform(program, "bending_share", static_cast<float>(at - std::floor(at)));
  }

  void draw_triangles(std::size_t first, std::size_t end) const {
    glBindVertexArray(vertex_array.name());
    glDrawElements(GL_TRIANGLES, static_cast<GLsizei>(end - first), GL_UNSIGNED_INT,
                   reinterpret_cast<const void*>(first * sizeof(std::int32_t)));
    glBindVertexArray(empty_array.name());
  }

  void draw_backdrop() const {
    glDisable(GL_DEPTH_TEST);
    glUseProgram(backdrop.name());
    set_uniform(backdrop, "above", 0.16F, 0.18F, 0.21F);
    set_uniform(backdrop, "below", 0.06F, 0.07F, 0.08F);
    glBindVertexArray(empty_array.name());
    glDrawArrays(GL_TRIANGLES, 0, 3);
  }

  void draw_lit(const Camera& camera, const SceneLook& look, const Viewport& viewport) {
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    draw_backdrop();
    glEnable(GL_DEPTH_TEST);
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT);
    use(lit, camera, look, viewport.aspect());
    glActiveTexture(GL_TEXTURE0 + colors_unit);
    glBindTexture(GL_TEXTURE_1D, (is_signed(look.value) ? diverging : sequential).name());
    set_uniform(lit, "colors", colors_unit);
    set_uniform(lit, "shaded", look.shaded ? 1 : 0);
    set_uniform_of(lit, "up", camera.up());
    set_uniform_of(lit, "left", -camera.right());
    const figure::Color plain = look.value == SurfaceValue::bending && bending_phases == 0
                                    ? figure::theme(figure::Look::dark).muted
                                    : figure::colors::lumen;
    set_uniform(lit, "plain", static_cast<float>(plain.r), static_cast<float>(plain.g),
                static_cast<float>(plain.b));
    // Half of a closed surface is not seen, and is half of the work of a software renderer.
    if (closed) glEnable(GL_CULL_FACE);
    set_uniform(lit, "cut_end", 0);
    draw_triangles(0, open_indices);
    set_uniform(lit, "cut_end", 1);
    draw_triangles(open_indices, indices);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
  }

  void draw_x_ray(const Camera& camera, const SceneLook& look, const Viewport& viewport) {
    x_ray.begin(viewport.width, viewport.height);
    use(depth, camera, look, viewport.aspect());
    set_uniform(depth, "isocentre_mm", static_cast<float>(camera.source_mm));
    // The picture is mirrored against what is seen from the source: rays enter through what appears
    // clockwise.
    set_uniform(depth, "entering", 1.0F);
    draw_triangles(0, indices);
    x_ray.end();
    glBindVertexArray(empty_array.name());
    x_ray.show(viewport, look.absorption_per_mm);
  }
};

BeatingScene::BeatingScene(const ShownSurface& surface, const motion::MovingCage& cage) {
  if (!has_opengl_33()) throw ResourceError("the scene needs OpenGL 3.3; there is " + renderer_name());
  impl_ = std::make_unique<Impl>(surface, cage);
  set_phase(cage.template_phase());
}

BeatingScene::~BeatingScene() = default;

void BeatingScene::set_bending(const BendingTable& table) {
  if (table.values.size() != static_cast<std::size_t>(table.phases) * impl_->vertices)
    throw InvalidInput("the table of curvatures is of another surface");
  impl_->bending.fill(table.values.data(), table.values.size());
  impl_->bending_phases = table.phases;
}

void BeatingScene::set_phase(double phase, double interval_s) {
  impl_->phase = phase;
  impl_->interval_s = interval_s;
  const std::vector<float> values = four_floats_each(impl_->cage.at(phase));
  impl_->control.fill(values.data(), values.size());
  impl_->rates_are_of_phase = false;
}

void BeatingScene::draw(const Camera& camera, const SceneLook& look, const Viewport& viewport) {
  impl_->update_rates(look);
  glDisable(GL_CULL_FACE);
  glDisable(GL_BLEND);
  if (camera.projection == Projection::x_ray)
    impl_->draw_x_ray(camera, look, viewport);
  else
    impl_->draw_lit(camera, look, viewport);
}

std::vector<Eigen::Vector3f> BeatingScene::places() {
  return impl_->captured<Eigen::Vector3f>("place", SceneLook{});
}

std::vector<Eigen::Vector3f> BeatingScene::normals() {
  auto normals = impl_->captured<Eigen::Vector3f>("shown_normal", SceneLook{});
  for (Eigen::Vector3f& n : normals) n.normalize();
  return normals;
}

std::vector<float> BeatingScene::values(const SceneLook& look) {
  impl_->update_rates(look);
  return impl_->captured<float>("value", look);
}

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
