#include "tree_window.h"

#include "frame_meter.h"
#include "gl_window.h"
#include "look_of_windows.h"
#include "measurements.h"
#include "pictures.h"
#include "start_clock.h"
#include "tree_viewer.h"
#include "waiting.h"

#include "ostia/core/error.h"
#include "ostia/glview/beating_scene.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_glfw.h>
#include <imgui.h>
#include <nlohmann/json.hpp>

#include <cstdio>

namespace ostia::live {
namespace {

constexpr double still_wait_s = 0.1;
constexpr double turn_px = 5.0;  // a picture

/// Dear ImGui's part of the window's events.
class TreeEvents {
 public:
  TreeEvents(GLFWwindow* window, TreeViewer& viewer) {
    glfwSetWindowUserPointer(window, &viewer);
    glfwSetKeyCallback(window, [](GLFWwindow* of, int key, int, int action, int) {
      if (action != GLFW_PRESS || ImGui::GetIO().WantTextInput) return;
      if (static_cast<TreeViewer*>(glfwGetWindowUserPointer(of))->key(key))
        glfwSetWindowShouldClose(of, GLFW_TRUE);
    });
    ImGui_ImplGlfw_InitForOpenGL(window, true);  // calls the callback above, too
  }
  ~TreeEvents() { ImGui_ImplGlfw_Shutdown(); }
  TreeEvents(const TreeEvents&) = delete;
  TreeEvents& operator=(const TreeEvents&) = delete;
};

void tell(TreeViewer& viewer, const std::vector<Screenshots::News>& news) {
  for (const Screenshots::News& one : news) {
    if (one.failed) std::fprintf(stderr, "ostia-live: %s\n", one.text.c_str());
    viewer.notice(one.text);
  }
}

std::string measured(const TreeViewer& viewer, const FrameMeter& meter, const TreeInput& input,
                     const StartTimes& times, int width, int height) {
  const Spread spread = meter.frame_ms();
  nlohmann::json result{
      {"renderer", glview::renderer_name()},
      {"width_px", width},
      {"height_px", height},
      {"first_picture_s", times.first_picture_s},
      {"prepared_s", times.prepared_s},
      {"frames", meter.frames()},
      {"frames_per_second", meter.frames_per_second()},
      {"frame_ms", {{"p50", spread.p50}, {"p95", spread.p95}, {"max", spread.max}, {"count", spread.count}}},
      {"segments", input.blocks->size()},
      {"shown", viewer.shown_segments()},
      {"drawn", viewer.choice().chosen},
      {"left_out", viewer.choice().left_out},
      {"hidden", viewer.choice().hidden},
      {"outside", viewer.choice().outside},
      {"distance_mm", viewer.eye().distance_mm},
      {"picked", nlohmann::json::array()}};
  for (const analysis::TreePlace& place : viewer.picked())
    result["picked"].push_back({{"reference", input.ruler->facts(place.edge).reference}, {"t", place.t}});
  return result.dump(2);
}

}  // namespace

void show_tree(const Options& options, const std::function<void(const TreeInput&)>& told,
               const core::TaskContext& task) {
  Preparation<TreeInput> work([&](const core::TaskContext& own) { return read_tree(options, own); });
  const auto held = window_beside(work, options);
  GLFWwindow* window = held->window;
  const Windows windows;
  StartTimes times;
  if (!show_waiting(window, work, times, task)) return;
  const TreeInput input = work.get();
  told(input);
  TreeViewer viewer(input, options);
  const TreeEvents events(window, viewer);
  Screenshots screenshots(options.pictures);
  FrameMeter meter(options.measure);
  const double start = glfwGetTime();
  int drawn = 0;
  while (glfwWindowShouldClose(window) == GLFW_FALSE && !task.cancelled()) {
    // Dear ImGui needs two pictures to answer what was done; a still one needs no processor.
    if (options.measure || options.turning || viewer.moved() || drawn < 3)
      glfwPollEvents();
    else
      glfwWaitEventsTimeout(still_wait_s);
    const double now = glfwGetTime();
    if (options.seconds && now - start >= *options.seconds) break;
    tell(viewer, screenshots.news());
    int width = 0, height = 0, wide_px = 0, high_px = 0;
    glfwGetWindowSize(window, &width, &height);
    glfwGetFramebufferSize(window, &wide_px, &high_px);
    if (width <= 0 || height <= 0 || wide_px <= 0 || high_px <= 0) {  // to an icon
      glfwWaitEventsTimeout(still_wait_s);
      continue;
    }
    if (options.turning && viewer.picked().empty()) viewer.turn(turn_px);
    ImGui_ImplGlfw_NewFrame();
    viewer.draw(width, height, meter.recent_frames_per_second());
    ++drawn;
    if (viewer.take_screenshot_wish()) tell(viewer, screenshots.take(glview::read_pixels(wide_px, high_px)));
    glfwSwapBuffers(window);
    if (options.measure) finish_drawing();
    if (drawn == 1) {
      times.prepared_s = seconds_since_start();
      glfwSetWindowTitle(window, window_title);
    }
    meter.shown(glfwGetTime(), 0, now, 0.0);
  }
  tell(viewer, screenshots.finish());
  if (!options.measure) return;
  int width = 0, height = 0;
  glfwGetFramebufferSize(window, &width, &height);
  std::printf("%s\n", measured(viewer, meter, input, times, width, height).c_str());
}

}  // namespace ostia::live
