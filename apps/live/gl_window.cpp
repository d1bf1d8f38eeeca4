#include "gl_window.h"

#include "options.h"

#include "ostia/core/error.h"
#include "ostia/glview/beating_scene.h"

#include <GLFW/glfw3.h>

#include <string>

namespace ostia::live {
namespace {

constexpr const char* way_out =
    " The live viewer needs OpenGL 3.3: update the graphics driver, or draw without the graphics card "
    "(install "
    "Mesa's software renderer, package libgl1-mesa-dri, and start with LIBGL_ALWAYS_SOFTWARE=1). Pictures "
    "and "
    "videos (--screenshot, --video) need no display.";

std::string last_error;

void on_error(int, const char* text) {
  last_error = text;
}

void close(GLFWwindow* window) {
  if (window != nullptr) glfwDestroyWindow(window);
  glfwTerminate();
}

}  // namespace

GlWindow::GlWindow(const Options& options) {
  glfwSetErrorCallback(on_error);
  if (glfwInit() != GLFW_TRUE)
    throw ResourceError("There is no display to open a window on (" + last_error + ")." + way_out);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MAJOR, 3);
  glfwWindowHint(GLFW_CONTEXT_VERSION_MINOR, 3);
  glfwWindowHint(GLFW_OPENGL_PROFILE, GLFW_OPENGL_CORE_PROFILE);
  glfwWindowHint(GLFW_OPENGL_FORWARD_COMPAT, GLFW_TRUE);
  window = glfwCreateWindow(options.width, options.height, window_title, nullptr, nullptr);
  if (window == nullptr) {
    const std::string why = last_error;
    glfwTerminate();
    throw ResourceError("No window with OpenGL 3.3 can be opened (" + why + ")." + way_out);
  }
  glfwMakeContextCurrent(window);
  glfwSwapInterval(options.vsync ? 1 : 0);
  if (glview::has_opengl_33()) return;
  const std::string instead = glview::renderer_name();
  close(window);
  throw ResourceError("There is " + instead + "." + way_out);
}

GlWindow::~GlWindow() {
  close(window);
}

}  // namespace ostia::live
