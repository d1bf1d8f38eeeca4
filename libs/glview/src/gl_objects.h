#pragma once
/// \file OpenGL's objects as values that end with their owner. Its context must be current in all of this.

#include "ostia/geometry/tri_mesh.h"

#include <epoxy/gl.h>

#include <cstddef>
#include <string>
#include <utility>

namespace ostia::glview {

/// A name that OpenGL gave, and how to give it back.
class GlObject {
 public:
  using Delete = void (*)(GLuint);
  GlObject() = default;
  GlObject(GLuint name, Delete remove) : name_(name), remove_(remove) {}
  GlObject(GlObject&& other) noexcept : name_(std::exchange(other.name_, 0)), remove_(other.remove_) {}
  GlObject& operator=(GlObject&& other) noexcept {
    std::swap(name_, other.name_);
    std::swap(remove_, other.remove_);
    return *this;
  }
  ~GlObject() {
    if (name_ != 0) remove_(name_);
  }
  GLuint name() const { return name_; }

 private:
  GLuint name_ = 0;
  Delete remove_ = nullptr;
};

GlObject new_buffer();
GlObject new_texture();
GlObject new_vertex_array();
GlObject new_framebuffer();
GlObject new_renderbuffer();

/// Compiled and linked. `captured` is what transform feedback writes, or null. Throws NumericalError with the
/// driver's message.
GlObject new_program(const std::string& vertex, const std::string& fragment, const char* captured = nullptr);

void set_uniform(const GlObject& program, const char* name, int value);
void set_uniform(const GlObject& program, const char* name, float value);
void set_uniform(const GlObject& program, const char* name, float x, float y, float z);
void set_uniform(const GlObject& program, const char* name, const geometry::Vec3& v);

/// A buffer that shaders read by number, 4 floats or 1 an entry.
struct BufferTexture {
  GlObject buffer = new_buffer(), texture = new_texture();
  GLenum format = GL_RGBA32F;
  explicit BufferTexture(GLenum of) : format(of) {}
  /// Throws ResourceError where shaders cannot read so much.
  void fill(const float* values, std::size_t count);
  void bind(int unit) const;
};

/// Throws ResourceError, with what was being done, where OpenGL has an error on record.
void check(const char* doing);

}  // namespace ostia::glview
