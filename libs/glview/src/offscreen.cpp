#include "ostia/glview/offscreen.h"

#include "gl_objects.h"

#include "ostia/core/error.h"
#include "ostia/glview/beating_scene.h"

#include <dlfcn.h>
#include <epoxy/egl.h>

#include <array>
#include <optional>
#include <string>

namespace ostia::glview {
namespace {

constexpr int most_px = 8192, least_px = 16;
constexpr const char* way_out =
    " Pictures need OpenGL 3.3 through EGL: update the graphics driver, or install Mesa's software renderer "
    "(packages libegl-mesa0 and libgl1-mesa-dri) and start with LIBGL_ALWAYS_SOFTWARE=1.";

/// A connection without any display: Mesa's, which knows cards and the software renderer, or the default one.
EGLDisplay open_display() {
  const char* extensions = eglQueryString(EGL_NO_DISPLAY, EGL_EXTENSIONS);
  const std::string known = extensions == nullptr ? "" : extensions;
  std::array<EGLDisplay, 3> tried{EGL_NO_DISPLAY, EGL_NO_DISPLAY, EGL_NO_DISPLAY};
  if (known.find("EGL_MESA_platform_surfaceless") != std::string::npos)
    tried[0] = eglGetPlatformDisplayEXT(EGL_PLATFORM_SURFACELESS_MESA, nullptr, nullptr);
  if (known.find("EGL_EXT_platform_device") != std::string::npos) {
    EGLDeviceEXT device = nullptr;
    EGLint count = 0;
    if (eglQueryDevicesEXT(1, &device, &count) == EGL_TRUE && count > 0)
      tried[1] = eglGetPlatformDisplayEXT(EGL_PLATFORM_DEVICE_EXT, device, nullptr);
  }
  tried[2] = eglGetDisplay(EGL_DEFAULT_DISPLAY);
  for (EGLDisplay display : tried)
    if (display != EGL_NO_DISPLAY && eglInitialize(display, nullptr, nullptr) == EGL_TRUE) return display;
  return EGL_NO_DISPLAY;
}

/// Owns the connection and the context.
class Context {
 public:
  Context() {
    // epoxy ends the process where the library is not there
    void* library = ::dlopen("libEGL.so.1", RTLD_LAZY);
    if (library == nullptr)
      throw ResourceError(std::string("The library libEGL.so.1 is not installed.") + way_out);
    display_ = open_display();
    if (display_ == EGL_NO_DISPLAY) throw ResourceError(std::string("EGL cannot be started.") + way_out);
    const std::array<EGLint, 5> wanted{EGL_RENDERABLE_TYPE, EGL_OPENGL_BIT, EGL_SURFACE_TYPE, EGL_DONT_CARE,
                                       EGL_NONE};
    EGLConfig config = nullptr;
    EGLint count = 0;
    eglBindAPI(EGL_OPENGL_API);
    eglChooseConfig(display_, wanted.data(), &config, 1, &count);
    const std::array<EGLint, 7> version{EGL_CONTEXT_MAJOR_VERSION,
                                        3,
                                        EGL_CONTEXT_MINOR_VERSION,
                                        3,
                                        EGL_CONTEXT_OPENGL_PROFILE_MASK,
                                        EGL_CONTEXT_OPENGL_CORE_PROFILE_BIT,
                                        EGL_NONE};
    context_ = eglCreateContext(display_, count > 0 ? config : nullptr, EGL_NO_CONTEXT, version.data());
    if (context_ == EGL_NO_CONTEXT ||
        eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, context_) != EGL_TRUE) {
      end();
      throw ResourceError(std::string("The graphics driver offers no OpenGL 3.3.") + way_out);
    }
  }
  ~Context() { end(); }
  Context(const Context&) = delete;
  Context& operator=(const Context&) = delete;

 private:
  void end() {
    eglMakeCurrent(display_, EGL_NO_SURFACE, EGL_NO_SURFACE, EGL_NO_CONTEXT);
    if (context_ != EGL_NO_CONTEXT) eglDestroyContext(display_, context_);
    eglTerminate(display_);
  }
  EGLDisplay display_ = EGL_NO_DISPLAY;
  EGLContext context_ = EGL_NO_CONTEXT;
};

}  // namespace

struct Offscreen::Impl {
  Context context;
  GlObject framebuffer = new_framebuffer(), color = new_renderbuffer(), depth = new_renderbuffer();
  int width, height;

  Impl(int wide, int high) : width(wide), height(high) {
    glBindFramebuffer(GL_FRAMEBUFFER, framebuffer.name());
    glBindRenderbuffer(GL_RENDERBUFFER, color.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_RGBA8, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_COLOR_ATTACHMENT0, GL_RENDERBUFFER, color.name());
    glBindRenderbuffer(GL_RENDERBUFFER, depth.name());
    glRenderbufferStorage(GL_RENDERBUFFER, GL_DEPTH_COMPONENT24, width, height);
    glFramebufferRenderbuffer(GL_FRAMEBUFFER, GL_DEPTH_ATTACHMENT, GL_RENDERBUFFER, depth.name());
    if (glCheckFramebufferStatus(GL_FRAMEBUFFER) != GL_FRAMEBUFFER_COMPLETE)
      throw ResourceError("OpenGL has no memory for a picture of " + std::to_string(width) + " x " +
                          std::to_string(height) + " pixels");
  }
};

Offscreen::Offscreen(int width, int height) {
  for (const int size : {width, height})
    if (size < least_px || size > most_px)
      throw InvalidInput("a picture of " + std::to_string(width) + " x " + std::to_string(height) +
                         " pixels cannot be made: " + std::to_string(least_px) + " to " +
                         std::to_string(most_px) + " can");
  impl_ = std::make_unique<Impl>(width, height);
}

Offscreen::~Offscreen() = default;

void Offscreen::bind() {
  glBindFramebuffer(GL_FRAMEBUFFER, impl_->framebuffer.name());
}

figure::Raster Offscreen::read() {
  bind();
  return read_pixels(impl_->width, impl_->height);
}

void Offscreen::finish() {
  glFinish();
}

std::string offscreen_trouble() {
  try {
    const Context context;
    return has_opengl_33() ? "" : "There is " + renderer_name() + "." + way_out;
  } catch (const ResourceError& error) {
    return error.what();
  }
}

}  // namespace ostia::glview
