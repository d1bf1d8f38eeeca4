#include "waiting.h"

#include "look_of_windows.h"

#include "ostia/glview/beating_scene.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>

#include <cmath>
#include <cstdio>
#include <string>

namespace ostia::live {
namespace {

constexpr std::chrono::milliseconds look_again{5};
constexpr double picture_every_s = 0.1;  // the processor is for what is prepared
constexpr float bar_wide = 320.0F, bar_high = 6.0F;

std::string said_of(const core::TaskContext& work) {
  const std::string stage = work.stage();
  return stage.empty() ? "preparing" : stage;
}

void draw_text_and_bar(const core::TaskContext& work, const ImVec2& size) {
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const std::string text = said_of(work);
  const ImVec2 extent = ImGui::CalcTextSize(text.c_str());
  const float y = std::floor(0.5F * size.y), left = std::floor(0.5F * (size.x - bar_wide));
  draw.AddText({std::floor(0.5F * (size.x - extent.x)), y - 2.0F * extent.y}, text_color, text.c_str());
  draw.AddRectFilled({left, y}, {left + bar_wide, y + bar_high}, grid_color);
  draw.AddRectFilled({left, y}, {left + bar_wide * static_cast<float>(work.progress()), y + bar_high},
                     accent_mark);
}

void draw_waiting(GLFWwindow* window, const core::TaskContext& work) {
  int width = 0, height = 0, wide_px = 0, high_px = 0;
  glfwGetWindowSize(window, &width, &height);
  glfwGetFramebufferSize(window, &wide_px, &high_px);
  if (width <= 0 || height <= 0) return;  // to an icon
  ImGuiIO& io = ImGui::GetIO();
  io.DisplaySize = {static_cast<float>(width), static_cast<float>(height)};
  io.DisplayFramebufferScale = {static_cast<float>(wide_px) / io.DisplaySize.x,
                                static_cast<float>(high_px) / io.DisplaySize.y};
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  draw_text_and_bar(work, io.DisplaySize);
  ImGui::Render();
  glview::begin_part({0, 0, wide_px, high_px}, glview::scene_backdrop);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
  glfwSwapBuffers(window);
}

void close_by_key(GLFWwindow* window, int key, int, int action, int) {
  if (action == GLFW_PRESS && (key == GLFW_KEY_Q || key == GLFW_KEY_ESCAPE))
    glfwSetWindowShouldClose(window, GLFW_TRUE);
}

}  // namespace

bool show_waiting(GLFWwindow* window, const core::TaskContext& work,
                  const std::function<bool(std::chrono::milliseconds)>& ready, StartTimes& times,
                  const core::TaskContext& task) {
  glfwSetKeyCallback(window, close_by_key);
  glfwSetWindowTitle(window, (std::string(window_title) + " (preparing)").c_str());
  double drawn_s = -1.0;
  do {
    if (const double now = glfwGetTime(); drawn_s < 0.0 || now - drawn_s >= picture_every_s) {
      draw_waiting(window, work);
      if (drawn_s < 0.0) times.first_picture_s = seconds_since_start();
      drawn_s = now;
    }
    glfwPollEvents();
    if (glfwWindowShouldClose(window) == GLFW_TRUE || task.cancelled()) {
      glfwHideWindow(window);  // at once, whatever the work takes to end
      return false;
    }
  } while (!ready(look_again));
  glfwSetKeyCallback(window, nullptr);
  return true;
}

}  // namespace ostia::live
