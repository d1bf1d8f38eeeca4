#pragma once
/// \file A window with OpenGL 3.3.

struct GLFWwindow;

namespace ostia::live {

struct Options;

/// Of a window whose keys are answered; another one stands there while it is prepared.
inline constexpr const char* window_title = "Ostia live";

/// GLFW's library, its window, whose context is current, and their end.
class GlWindow {
 public:
  /// Throws ResourceError that tells the way out.
  explicit GlWindow(const Options& options);
  ~GlWindow();
  GlWindow(const GlWindow&) = delete;
  GlWindow& operator=(const GlWindow&) = delete;
  GLFWwindow* window = nullptr;
};

}  // namespace ostia::live
