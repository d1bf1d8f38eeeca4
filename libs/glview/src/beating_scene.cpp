#include "ostia/glview/beating_scene.h"

#include "gl_objects.h"
#include "lit_programs.h"
#include "shaders.h"
#include "x_ray_layer.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstring>

namespace ostia::glview {
namespace {

constexpr int control_unit = 1, rates_unit = 2, bending_unit = 3;
constexpr GLuint along_attribute = 4;

std::vector<float> four_floats_each(const std::vector<Vec3>& points) {
  std::vector<float> values(4 * points.size(), 0.0F);
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t axis = 0; axis < 3; ++axis)
      values[4 * i + axis] = static_cast<float>(points[i][static_cast<Eigen::Index>(axis)]);
  return values;
}

void add_attribute(GLuint index, std::size_t each, std::size_t offset) {
  glEnableVertexAttribArray(index);
  glVertexAttribPointer(index, 3, GL_FLOAT, GL_FALSE, static_cast<GLsizei>(each),
                        reinterpret_cast<const void*>(offset));
}

}  // namespace

struct BeatingScene::Impl {
  motion::MovingCage cage;
  geometry::CageGrid grid;
  std::size_t vertices, open_indices, indices;
  bool closed;
  LitPrograms lit;
  GlObject depth;  // compiled with the layer, when a picture first needs them
  std::unique_ptr<XRayLayer> x_ray;
  GlObject vertex_array = new_vertex_array(), empty_array = new_vertex_array();
  GlObject vertex_buffer = new_buffer(), along_buffer = new_buffer(), index_buffer = new_buffer();
  BufferTexture control{GL_RGBA32F}, rates{GL_RGBA32F}, bending{GL_R32F};
  int bending_phases = 0;
  bool has_along = false;
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
    add_attribute(1, sizeof(ShownVertex), offsetof(ShownVertex, local));
    add_attribute(2, sizeof(ShownVertex), offsetof(ShownVertex, rest));
    add_attribute(3, sizeof(ShownVertex), offsetof(ShownVertex, normal));
    glBindBuffer(GL_ELEMENT_ARRAY_BUFFER, index_buffer.name());
    glBufferData(GL_ELEMENT_ARRAY_BUFFER, static_cast<GLsizeiptr>(indices * sizeof(std::int32_t)),
                 surface.triangles.data(), GL_STATIC_DRAW);
    glBindVertexArray(0);
    const float nothing[4] = {};
    rates.fill(nothing, 4);
    bending.fill(nothing, 1);
    check("the surface goes to the graphics card");
    if (!surface.along.empty()) set_directions(surface.along);
  }

  void set_directions(const std::vector<Direction>& along) {
    if (along.size() != vertices) throw InvalidInput("the directions are of another surface");
    glBindVertexArray(vertex_array.name());
    glBindBuffer(GL_ARRAY_BUFFER, along_buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(along.size() * sizeof(Direction)), along.data(),
                 GL_STATIC_DRAW);
    add_attribute(along_attribute, sizeof(Direction), 0);
    glBindVertexArray(0);
    check("directions go to the graphics card");
    has_along = true;
  }

  /// False for what is not there yet: then it is drawn without.
  bool can_show(SurfaceValue value) const {
    if (value == SurfaceValue::bending) return bending_phases > 0;
    if (value == SurfaceValue::stretch) return has_along;
    return value != SurfaceValue::none;
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
    set_uniform(program, "cell_mm", grid.cell_mm);
    set_uniform(program, "low", grid.origin);
    set_uniform(program, "high", grid.origin + grid.cells * grid.cell_mm);
    const Eigen::Matrix4f matrix = camera.clip_of_world(aspect);
    glUniformMatrix4fv(glGetUniformLocation(program.name(), "clip_of_world"), 1, GL_FALSE, matrix.data());
    set_uniform(program, "eye", camera.centre_of_projection());
    set_uniform(program, "value_kind", can_show(look.value) ? static_cast<int>(look.value) : 0);
    glUniform2f(glGetUniformLocation(program.name(), "value_range"), static_cast<float>(look.range.low),
                static_cast<float>(look.range.high));
    set_uniform(program, "interval_s", static_cast<float>(interval_s));
    if (look.value == SurfaceValue::bending && bending_phases > 0) set_bending_phase(program);
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
    const GlObject program = new_program(surface_vertex_shader(true), lit_fragment_shader(true, false), name);
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

  /// In the colours of its values, or in one.
  void draw_part(const Camera& camera, const SceneLook& look, double aspect, bool cut_end) {
    const bool valued = can_show(look.value);
    const GlObject& program = lit.of(valued, cut_end);
    use(program, camera, look, aspect);
    lit.set_look(program, valued, camera, look);
    if (cut_end)
      draw_triangles(open_indices, indices);
    else
      draw_triangles(0, open_indices);
  }

  void draw_lit(const Camera& camera, const SceneLook& look, const Viewport& viewport) {
    // All of it at once, colours and depths: a part costs a software renderer several times as much.
    glDisable(GL_SCISSOR_TEST);
    glDepthMask(GL_TRUE);
    glClearColor(static_cast<float>(scene_backdrop.r), static_cast<float>(scene_backdrop.g),
                 static_cast<float>(scene_backdrop.b), 1.0F);
    glClear(GL_COLOR_BUFFER_BIT | GL_DEPTH_BUFFER_BIT);
    glViewport(viewport.x, viewport.y, viewport.width, viewport.height);
    glEnable(GL_DEPTH_TEST);
    // Half of a closed surface is not seen, and is half of the work of a software renderer.
    if (closed) glEnable(GL_CULL_FACE);
    draw_part(camera, look, viewport.aspect(), false);
    if (indices > open_indices) draw_part(camera, look, viewport.aspect(), true);
    glDisable(GL_CULL_FACE);
    glDisable(GL_DEPTH_TEST);
  }

  void draw_x_ray(const Camera& camera, const SceneLook& look, const Viewport& viewport) {
    if (!x_ray) {
      x_ray = std::make_unique<XRayLayer>();
      depth = new_program(surface_vertex_shader(false), depth_fragment_shader());
    }
    x_ray->begin(viewport.width, viewport.height);
    use(depth, camera, look, viewport.aspect());
    set_uniform(depth, "isocentre_mm", static_cast<float>(camera.source_mm));
    // The picture is mirrored against what is seen from the source: rays enter through what appears
    // clockwise.
    set_uniform(depth, "entering", 1.0F);
    draw_triangles(0, indices);
    x_ray->end();
    glBindVertexArray(empty_array.name());
    x_ray->show(viewport, look.absorption_per_mm);
  }
};

BeatingScene::BeatingScene(const ShownSurface& surface, const motion::MovingCage& cage) {
  if (!has_opengl_33()) throw ResourceError("the scene needs OpenGL 3.3; there is " + renderer_name());
  impl_ = std::make_unique<Impl>(surface, cage);
  set_phase(cage.template_phase());
}

BeatingScene::~BeatingScene() = default;

void BeatingScene::set_directions(const std::vector<Direction>& along) {
  impl_->set_directions(along);
}

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

}  // namespace ostia::glview
