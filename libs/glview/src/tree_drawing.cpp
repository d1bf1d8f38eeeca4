#include "ostia/glview/tree_drawing.h"

#include "gl_objects.h"

#include <Eigen/Core>

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ostia::glview {

using geometry::DrawnSegment;
using geometry::Vec3;

namespace {

constexpr float line_px = 0.75f;  // radius below which a segment is drawn as a line of one pixel

// A strip that faces the eye along the segment, longer by a half disc at either end: seen along the segment,
// or at a bend, the vessel stays round.
constexpr const char* vertex_code = R"(#version 330 core
layout(location = 0) in vec4 from;
layout(location = 1) in vec4 to;
layout(location = 2) in int edge;
uniform mat4 view, projection;
uniform float pixel;   // of a length at depth 1
uniform int highlight;
out vec2 place;              // along the strip from the first end, and across it
flat out vec3 shape;         // radii at both ends, length of the strip's axis
out vec3 colour;
void main() {
  vec3 a = (view * vec4(from.xyz, 1)).xyz, b = (view * vec4(to.xyz, 1)).xyz;
  bool end = (gl_VertexID & 2) != 0;
  float side = (gl_VertexID & 1) != 0 ? 1.0 : -1.0;
  vec3 at = end ? b : a;
  vec3 across = cross(b - a, -at);
  float most = length(across);
  across = most > 0.0 ? across / most : vec3(1, 0, 0);
  vec3 along = normalize(cross(-at, across));
  if (dot(along, b - a) < 0.0) along = -along;
  bool chosen = edge == highlight;
  float least = (chosen ? 2.5 : 0.6) * pixel;
  float more = chosen ? 1.15 : 1.0;
  shape.x = max(from.w * more, least * abs(a.z));
  shape.y = max(to.w * more, least * abs(b.z));
  shape.z = dot(b - a, along);
  float radius = end ? shape.y : shape.x;
  // Ends of what is about a pixel wide are not seen.
  float beyond = radius > 1.5 * pixel * abs(at.z) ? (end ? radius : -radius) : 0.0;
  place = vec2((end ? shape.z : 0.0) + beyond, side * radius);
  gl_Position = projection * vec4(at + beyond * along + side * radius * across, 1);
  if (chosen) gl_Position.z -= 1e-4 * gl_Position.w;
  colour = chosen ? vec3(1.0, 0.85, 0.1) : vec3(0.80, 0.27, 0.23);
}
)";

constexpr const char* fragment_code = R"(#version 330 core
in vec2 place;
flat in vec3 shape;
in vec3 colour;
out vec4 result;
void main() {
  float beyond = place.x < 0.0 ? place.x : max(0.0, place.x - shape.z);
  float radius = mix(shape.x, shape.y, shape.z > 0.0 ? clamp(place.x / shape.z, 0.0, 1.0) : 0.0);
  vec2 off = vec2(beyond, place.y) / radius;
  if (beyond != 0.0 && dot(off, off) > 1.0) discard;
  // Also beyond the ends as across the vessel: there it covers its neighbours, which look the same.
  result = vec4(colour * (0.35 + 0.65 * sqrt(max(0.0, 1.0 - off.y * off.y))), 1);
}
)";

// What is about a pixel wide: as bright as the strip is in the mean over its width.
constexpr const char* line_vertex_code = R"(#version 330 core
layout(location = 0) in vec4 from;
layout(location = 1) in vec4 to;
uniform mat4 view, projection;
void main() {
  gl_Position = projection * (view * vec4(gl_VertexID == 0 ? from.xyz : to.xyz, 1));
}
)";

constexpr const char* line_fragment_code = R"(#version 330 core
out vec4 result;
void main() {
  result = vec4(0.86 * vec3(0.80, 0.27, 0.23), 1);
}
)";

/// World, from the blocks' centre, to the eye's space.
Eigen::Matrix4f view_of(const TreeCamera& eye, const Vec3& centre) {
  Eigen::Matrix4d view = Eigen::Matrix4d::Identity();
  view.block<1, 3>(0, 0) = eye.right.transpose();
  view.block<1, 3>(1, 0) = eye.up.transpose();
  view.block<1, 3>(2, 0) = eye.back.transpose();
  view.block<3, 1>(0, 3) = -view.block<3, 3>(0, 0) * (eye.eye() - centre);
  return view.cast<float>();
}

Eigen::Matrix4f projection_of(const geometry::BlockView& view, double near, double far) {
  Eigen::Matrix4d out = Eigen::Matrix4d::Zero();
  out(0, 0) = 1.0 / view.half_width;
  out(1, 1) = 1.0 / view.half_height;
  out(2, 2) = (far + near) / (near - far);
  out(2, 3) = 2.0 * far * near / (near - far);
  out(3, 2) = -1.0;
  return out.cast<float>();
}

void set_matrix(const GlObject& program, const char* name, const Eigen::Matrix4f& matrix) {
  glUniformMatrix4fv(glGetUniformLocation(program.name(), name), 1, GL_FALSE, matrix.data());
}

}  // namespace

struct TreeDrawing::Impl {
  std::shared_ptr<const geometry::SegmentBlocks> blocks;
  GlObject program = new_program(vertex_code, fragment_code);
  GlObject line_program = new_program(line_vertex_code, line_fragment_code);
  GlObject array = new_vertex_array(), buffer = new_buffer();
  std::vector<DrawnSegment> drawn, lines;
  std::size_t strips = 0;
  geometry::BlockChoice choice;
  std::size_t most = most_segments;

  explicit Impl(std::shared_ptr<const geometry::SegmentBlocks> all) : blocks(std::move(all)) {
    glBindVertexArray(array.name());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    for (unsigned int i = 0; i < 3; ++i) {
      glEnableVertexAttribArray(i);
      glVertexAttribDivisor(i, 1);
    }
    glBindVertexArray(0);
  }

  /// From the buffer's segment with that number on.
  void read_from(std::size_t first) {
    const auto offset = [first](std::size_t bytes) {
      return reinterpret_cast<const void*>(first * sizeof(DrawnSegment) + bytes);
    };
    glVertexAttribPointer(0, 4, GL_FLOAT, GL_FALSE, sizeof(DrawnSegment), offset(0));
    glVertexAttribPointer(1, 4, GL_FLOAT, GL_FALSE, sizeof(DrawnSegment), offset(offsetof(DrawnSegment, to)));
    glVertexAttribIPointer(2, 1, GL_INT, sizeof(DrawnSegment), offset(offsetof(DrawnSegment, edge)));
  }

  /// Those that are drawn as strips come first.
  void part(const geometry::BlockView& view) {
    const Eigen::Vector3f eye = (view.eye - blocks->centre()).cast<float>(), back = view.back.cast<float>();
    const float pixel = static_cast<float>(2.0 * view.half_height / view.height_px);
    lines.clear();
    strips = 0;
    for (const DrawnSegment& one : drawn) {
      const float from = back.dot(eye - Eigen::Vector3f(one.from[0], one.from[1], one.from[2])),
                  to = back.dot(eye - Eigen::Vector3f(one.to[0], one.to[1], one.to[2]));
      const bool line = one.thickness() < line_px * pixel * std::min(from, to);
      if (line)
        lines.push_back(one);
      else
        drawn[strips++] = one;
    }
    drawn.resize(strips);
  }

  void fill(const geometry::BlockView& view, std::span<const std::uint8_t> shown, std::int32_t highlight) {
    choice = blocks->choose(view, shown, most, drawn);
    part(view);
    const DrawnSegment* chosen = blocks->segment(highlight);
    if (chosen != nullptr && (shown.empty() || shown[static_cast<std::size_t>(highlight)] != 0))
      drawn.push_back(*chosen);
    strips = drawn.size();
    drawn.insert(drawn.end(), lines.begin(), lines.end());
    glBindBuffer(GL_ARRAY_BUFFER, buffer.name());
    glBufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(drawn.size() * sizeof(DrawnSegment)), drawn.data(),
                 GL_STREAM_DRAW);
  }
};

TreeDrawing::TreeDrawing(std::shared_ptr<const geometry::SegmentBlocks> blocks)
    : impl_(std::make_unique<Impl>(std::move(blocks))) {}

TreeDrawing::~TreeDrawing() = default;

const geometry::BlockChoice& TreeDrawing::choice() const {
  return impl_->choice;
}

void TreeDrawing::set_most(std::size_t segments) {
  impl_->most = segments;
}

void TreeDrawing::draw(const TreeCamera& eye, double pixel_ratio, std::span<const std::uint8_t> shown,
                       std::int32_t highlight) {
  const geometry::BlockView view = eye.view(pixel_ratio);
  impl_->fill(view, shown, highlight);
  const geometry::SegmentBlocks& blocks = *impl_->blocks;
  const double reach = (blocks.high() - blocks.low()).norm(), away = (eye.eye() - blocks.centre()).norm();
  const double far = away + reach, near = std::max(away - reach, 1e-3 * std::min(eye.distance_mm, far));
  glEnable(GL_DEPTH_TEST);
  glDisable(GL_BLEND);
  glDisable(GL_CULL_FACE);
  glUseProgram(impl_->program.name());
  set_matrix(impl_->program, "view", view_of(eye, blocks.centre()));
  set_matrix(impl_->program, "projection", projection_of(view, near, far));
  set_uniform(impl_->program, "pixel", static_cast<float>(2.0 * view.half_height / view.height_px));
  set_uniform(impl_->program, "highlight", highlight);
  glBindVertexArray(impl_->array.name());
  impl_->read_from(0);
  glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, static_cast<GLsizei>(impl_->strips));
  glUseProgram(impl_->line_program.name());
  set_matrix(impl_->line_program, "view", view_of(eye, blocks.centre()));
  set_matrix(impl_->line_program, "projection", projection_of(view, near, far));
  impl_->read_from(impl_->strips);
  glDrawArraysInstanced(GL_LINES, 0, 2, static_cast<GLsizei>(impl_->drawn.size() - impl_->strips));
  glBindVertexArray(0);
  glUseProgram(0);
  glDisable(GL_DEPTH_TEST);
}

}  // namespace ostia::glview
