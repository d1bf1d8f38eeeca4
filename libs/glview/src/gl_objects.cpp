#include "gl_objects.h"

#include "ostia/core/error.h"

#include <array>

namespace ostia::glview {
namespace {

GlObject shader(GLenum kind, const std::string& text) {
  GlObject object(glCreateShader(kind), [](GLuint name) { glDeleteShader(name); });
  const char* source = text.c_str();
  glShaderSource(object.name(), 1, &source, nullptr);
  glCompileShader(object.name());
  GLint done = 0;
  glGetShaderiv(object.name(), GL_COMPILE_STATUS, &done);
  if (done == GL_TRUE) return object;
  std::array<char, 2048> said{};
  glGetShaderInfoLog(object.name(), static_cast<GLsizei>(said.size()), nullptr, said.data());
  throw NumericalError(std::string("the graphics driver does not take a shader: ") + said.data());
}

GLint place(const GlObject& program, const char* name) {
  return glGetUniformLocation(program.name(), name);
}

}  // namespace

GlObject new_buffer() {
  GLuint name = 0;
  glGenBuffers(1, &name);
  return {name, [](GLuint n) { glDeleteBuffers(1, &n); }};
}

GlObject new_texture() {
  GLuint name = 0;
  glGenTextures(1, &name);
  return {name, [](GLuint n) { glDeleteTextures(1, &n); }};
}

GlObject new_vertex_array() {
  GLuint name = 0;
  glGenVertexArrays(1, &name);
  return {name, [](GLuint n) { glDeleteVertexArrays(1, &n); }};
}

GlObject new_framebuffer() {
  GLuint name = 0;
  glGenFramebuffers(1, &name);
  return {name, [](GLuint n) { glDeleteFramebuffers(1, &n); }};
}

GlObject new_renderbuffer() {
  GLuint name = 0;
  glGenRenderbuffers(1, &name);
  return {name, [](GLuint n) { glDeleteRenderbuffers(1, &n); }};
}

GlObject new_program(const std::string& vertex, const std::string& fragment, const char* captured) {
  const GlObject first = shader(GL_VERTEX_SHADER, vertex), second = shader(GL_FRAGMENT_SHADER, fragment);
  GlObject program(glCreateProgram(), [](GLuint name) { glDeleteProgram(name); });
  glAttachShader(program.name(), first.name());
  glAttachShader(program.name(), second.name());
  if (captured != nullptr) glTransformFeedbackVaryings(program.name(), 1, &captured, GL_INTERLEAVED_ATTRIBS);
  glLinkProgram(program.name());
  GLint done = 0;
  glGetProgramiv(program.name(), GL_LINK_STATUS, &done);
  if (done == GL_TRUE) return program;
  std::array<char, 2048> said{};
  glGetProgramInfoLog(program.name(), static_cast<GLsizei>(said.size()), nullptr, said.data());
  throw NumericalError(std::string("the graphics driver does not link a program: ") + said.data());
}

void set_uniform(const GlObject& program, const char* name, int value) {
  glUniform1i(place(program, name), value);
}

void set_uniform(const GlObject& program, const char* name, float value) {
  glUniform1f(place(program, name), value);
}

void set_uniform(const GlObject& program, const char* name, float x, float y, float z) {
  glUniform3f(place(program, name), x, y, z);
}

void set_uniform(const GlObject& program, const char* name, const geometry::Vec3& v) {
  set_uniform(program, name, static_cast<float>(v.x()), static_cast<float>(v.y()), static_cast<float>(v.z()));
}

void BufferTexture::fill(const float* values, std::size_t count) {
  GLint most = 0;
  glGetIntegerv(GL_MAX_TEXTURE_BUFFER_SIZE, &most);
  const std::size_t entries = format == GL_RGBA32F ? count / 4 : count;
  if (most > 0 && entries > static_cast<std::size_t>(most))
    throw ResourceError("the graphics card reads " + std::to_string(most) +
                        " entries of a table at most, and " + std::to_string(entries) + " are asked for");
  const auto bytes = static_cast<GLsizeiptr>(count * sizeof(float));
  glBindBuffer(GL_TEXTURE_BUFFER, buffer.name());
  // Fresh memory each time, so that the picture before, which may still be drawn, is not waited for.
  glBufferData(GL_TEXTURE_BUFFER, bytes, values, GL_STREAM_DRAW);
  glBindTexture(GL_TEXTURE_BUFFER, texture.name());
  glTexBuffer(GL_TEXTURE_BUFFER, format, buffer.name());
}

void BufferTexture::bind(int unit) const {
  glActiveTexture(static_cast<GLenum>(GL_TEXTURE0 + unit));
  glBindTexture(GL_TEXTURE_BUFFER, texture.name());
}

void check(const char* doing) {
  const GLenum error = glGetError();
  if (error == GL_NO_ERROR) return;
  while (glGetError() != GL_NO_ERROR) {
  }
  throw ResourceError(std::string("OpenGL fails (error ") + std::to_string(error) + ") while " + doing);
}

}  // namespace ostia::glview
