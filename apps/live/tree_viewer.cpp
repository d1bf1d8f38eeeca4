#include "tree_viewer.h"

#include "look_of_windows.h"
#include "panel.h"

#include "ostia/glview/beating_scene.h"
#include "ostia/glview/carm_camera.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::live {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double tree_zoom_step = 1.12, reach_px = 3.0;
constexpr float click_px = 4.0F;
glview::TreeCamera eye_of(const Options& options) {
  glview::Camera camera;
  camera.angles = options.view;
  glview::TreeCamera eye;
  eye.back = camera.towards();
  eye.right = camera.right();
  eye.up = eye.back.cross(eye.right);
  eye.width_px = options.width;
  eye.height_px = options.height;
  return eye;
}

}  // namespace

TreeViewer::TreeViewer(const TreeInput& input, const Options& options)
    : input_(input),
      drawing_(input.blocks),
      eye_(glview::fitted(eye_of(options), input.blocks->low(), input.blocks->high())),
      shown_segments_(input.blocks->size()),
      notices_(input.warnings),
      region_mm_(static_cast<float>(0.05 * (input.blocks->high() - input.blocks->low()).norm())),
      panels_(options.panels) {}

bool TreeViewer::key(int key) {
  moved_ = true;
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (!help_) return true;
      help_ = false;
      break;
    case GLFW_KEY_Q:
      return true;
    case GLFW_KEY_HOME:
      eye_ = glview::fitted(eye_, input_.blocks->low(), input_.blocks->high());
      break;
    case GLFW_KEY_F:
      go_to_subtree();
      break;
    case GLFW_KEY_T:
      show_subtree(shown_.empty());
      break;
    case GLFW_KEY_R:
      region_ = !region_;
      within_.reset();
      break;
    case GLFW_KEY_G:
      grid_ = !grid_;
      break;
    case GLFW_KEY_BACKSPACE:
      picked_.clear();
      within_.reset();
      break;
    case GLFW_KEY_S:
      screenshot_ = true;
      break;
    case GLFW_KEY_TAB:
      panels_ = !panels_;
      break;
    case GLFW_KEY_F1:
    case GLFW_KEY_H:
      help_ = !help_;
      break;
    default:
      break;
  }
  return false;
}

bool TreeViewer::take_screenshot_wish() {
  return std::exchange(screenshot_, false);
}

void TreeViewer::turn(double right_px) {
  eye_ = glview::turned(eye_, {right_px, 0.0});
  moved_ = true;
}

void TreeViewer::pick(const Vec2& place) {
  const glview::CameraRay ray = eye_.ray(place);
  const auto hit = input_.rays->first({ray.origin, ray.direction, reach_px * ray.pixel}, shown_);
  if (!hit) return;
  if (picked_.size() == 2) picked_.erase(picked_.begin());
  picked_.push_back(hit->place);
  within_.reset();
}

void TreeViewer::show_subtree(bool only) {
  shown_.clear();
  if (only && !picked_.empty()) shown_ = input_.ruler->subtree(picked_.back().edge);
  if (std::find(shown_.begin(), shown_.end(), 1) == shown_.end()) shown_.clear();  // of no tree
  shown_segments_ = shown_.empty()
                        ? input_.blocks->size()
                        : static_cast<std::size_t>(std::count(shown_.begin(), shown_.end(), std::uint8_t{1}));
}

void TreeViewer::go_to_subtree() {
  if (picked_.empty()) return;
  const std::vector<std::uint8_t> of = input_.ruler->subtree(picked_.back().edge);
  geometry::Box3 box;
  for (std::size_t e = 0; e < of.size(); ++e) {
    if (of[e] == 0 && static_cast<std::int32_t>(e) != picked_.back().edge) continue;
    const geometry::GraphEdge& edge = input_.graph->edges[e];
    for (const std::int32_t p : {edge.from, edge.to})
      if (const Vec3& point = input_.graph->points[static_cast<std::size_t>(p)]; point.allFinite())
        box.extend(point);
  }
  if (!box.isEmpty()) eye_ = glview::fitted(eye_, box.min(), box.max());
}

void TreeViewer::mouse(int width, int height) {
  const ImGuiIO& io = ImGui::GetIO();
  const Vec2 at(static_cast<double>(io.MousePos.x), static_cast<double>(io.MousePos.y));
  const bool over =
      !io.WantCaptureMouse && at.x() >= 0.0 && at.y() >= 0.0 && at.x() < width && at.y() < height;
  if (over && io.MouseWheel != 0.0F) {
    eye_ = glview::nearer(eye_, std::pow(tree_zoom_step, -static_cast<double>(io.MouseWheel)), at);
    moved_ = true;
  }
  if (over && (ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2))) {
    grabbed_ = true;
    dragged_ = false;
    return;  // the way to where it is grabbed is none of it
  }
  if (!grabbed_) return;
  const Vec2 by(static_cast<double>(io.MouseDelta.x), static_cast<double>(io.MouseDelta.y));
  for (int button = 0; button < 3; ++button) dragged_ = dragged_ || ImGui::IsMouseDragging(button, click_px);
  if (dragged_ && by.norm() > 0.0) {
    moved_ = true;
    if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift))
      eye_ = glview::moved(eye_, by);
    else if (io.MouseDown[0])
      eye_ = glview::turned(eye_, by);
    else if (io.MouseDown[1])
      eye_ = glview::nearer(eye_, std::pow(tree_zoom_step, by.y() / 20.0));
  }
  if (io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2]) return;
  grabbed_ = false;
  moved_ = true;
  if (!dragged_ && ImGui::IsMouseReleased(0)) pick(at);
  if (!dragged_ && io.MouseClickedCount[0] == 2) go_to_subtree();
}

void TreeViewer::draw(int width, int height, double frames_per_second) {
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  moved_ = false;
  const int wide = std::max(16, width - (panels_ ? panel_width : 0));
  eye_.width_px = wide;
  eye_.height_px = std::max(16, height);
  if (!std::exchange(placed_, true)) eye_ = glview::fitted(eye_, input_.blocks->low(), input_.blocks->high());
  mouse(wide, height);
  if (grid_) grid();
  marks(wide, height);
  if (panels_) panel(width, height, frames_per_second);
  ImGui::Render();
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  const auto px = [](int units, float each) {
    return static_cast<int>(std::lround(static_cast<double>(units) * static_cast<double>(each)));
  };
  const glview::Viewport scene{0, 0, px(wide, scale.x), px(height, scale.y)};
  glview::begin_part(scene, glview::scene_backdrop);
  drawing_.draw(eye_, static_cast<double>(scale.y), shown_, picked_.empty() ? -1 : picked_.back().edge);
  if (panels_) glview::fill({scene.width, 0, px(width - wide, scale.x), scene.height}, panel_background);
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

}  // namespace ostia::live
