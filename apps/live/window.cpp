#include "window.h"

#include "gl_window.h"
#include "look_of_windows.h"
#include "measurements.h"
#include "pictures.h"
#include "start_clock.h"
#include "viewer.h"
#include "waiting.h"

#include "ostia/core/error.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

namespace ostia::live {
namespace {

constexpr double longest_step_s = 0.5;  // after the machine slept
constexpr double paused_wait_s = 1.0 / 30.0;

/// Dear ImGui's part of the window's events.
class Events {
 public:
  Events(GLFWwindow* window, Viewer& viewer) {
    glfwSetWindowUserPointer(window, &viewer);
    glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int mods) {
      const bool steps =
          key == GLFW_KEY_LEFT || key == GLFW_KEY_RIGHT || key == GLFW_KEY_UP || key == GLFW_KEY_DOWN;
      if (action == GLFW_RELEASE || (action == GLFW_REPEAT && !steps)) return;
      if (ImGui::GetIO().WantTextInput) return;  // a number is typed into a slider
      auto& shown = *static_cast<Viewer*>(glfwGetWindowUserPointer(of));
      if (shown.key(key, (mods & GLFW_MOD_SHIFT) != 0)) glfwSetWindowShouldClose(of, GLFW_TRUE);
    });
    ImGui_ImplGlfw_InitForOpenGL(window, true);  // calls the callback above, too
  }
  ~Events() { ImGui_ImplGlfw_Shutdown(); }
  Events(const Events&) = delete;
  Events& operator=(const Events&) = delete;
};

void tell(Viewer& viewer, const std::vector<Screenshots::News>& news) {
  for (const Screenshots::News& one : news) {
    if (one.failed) std::fprintf(stderr, "ostia-live: %s\n", one.text.c_str());
    viewer.notice(one.text);
  }
}

}  // namespace

void show_window(const Options& options, const std::function<void(const LiveInput&)>& told,
                 const core::TaskContext& task) {
  Preparation<LiveHeart> work([&](const core::TaskContext& own) { return read_heart(options, own); });
  const auto held = window_beside(work, options);
  GLFWwindow* window = held->window;
  const Windows windows;
  StartTimes times;
  if (!show_waiting(window, work, times, task)) return;
  LiveHeart heart = work.get();
  told(heart.input);
  Viewer viewer(std::move(heart), options);
  const Events events(window, viewer);
  Screenshots screenshots(options.pictures);
  FrameMeter meter(options.measure);
  // The first picture takes longest: the driver compiles. The stream begins with the second.
  ImGui_ImplGlfw_NewFrame();
  viewer.draw(options.width, options.height, 0.0);
  glfwSwapBuffers(window);
  finish_drawing();
  times.prepared_s = seconds_since_start();
  glfwSetWindowTitle(window, window_title);
  const double start = glfwGetTime();
  double before = start;
  while (glfwWindowShouldClose(window) == GLFW_FALSE && !task.cancelled()) {
    if (viewer.playback().paused())
      glfwWaitEventsTimeout(paused_wait_s);  // a still picture needs no processor
    else
      glfwPollEvents();
    const double now = glfwGetTime();
    if (options.seconds && now - start >= *options.seconds) break;
    const std::size_t samples = viewer.advance(std::min(now - before, longest_step_s));
    before = now;
    tell(viewer, screenshots.news());
    int width = 0, height = 0, wide_px = 0, high_px = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &wide_px, &high_px);
    if (width <= 0 || height <= 0 || wide_px <= 0 || high_px <= 0) {  // to an icon
      glfwWaitEventsTimeout(paused_wait_s);
      continue;
    }
    ImGui_ImplGlfw_NewFrame();
    viewer.draw(width, height, meter.recent_frames_per_second());
    if (viewer.take_wishes().screenshot)
      tell(viewer, screenshots.take(glview::read_pixels(wide_px, high_px)));
    glfwSwapBuffers(window);
    if (options.measure) finish_drawing();
    const Playback& play = viewer.playback();
    const double apart = play.feed() ? 1.0 / play.feed()->samples_per_second() / play.speed() : 0.0;
    const double newest = play.feed() ? now - (play.stream_s() - play.feed()->time_s()) / play.speed() : now;
    meter.shown(glfwGetTime(), samples, newest, apart);
  }
  tell(viewer, screenshots.finish());
  if (options.measure) {
    int width = 0, height = 0;
    glfwGetFramebufferSize(window, &width, &height);
    std::printf("%s\n", measurements_json(viewer, meter, times, width, height, screenshots.count()).c_str());
  }
}

}  // namespace ostia::live
