#include "viewer.h"

#include "ecg_strip.h"
#include "look_of_windows.h"
#include "panel.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"

#include <GLFW/glfw3.h>
#include <backends/imgui_impl_opengl3.h>
#include <imgui.h>

#include <algorithm>
#include <cmath>

namespace ostia::live {
namespace {

using glview::SurfaceValue;

constexpr double phase_step = 0.01, seek_step_s = 5.0, zoom_step = 1.12;

std::optional<EcgFeed> feed_of(const LiveInput& input) {
  if (!input.ecg) return {};
  return EcgFeed(input.ecg->lead.values, input.ecg->samples_per_second);
}

/// What panel and strip leave of the window.
glview::Viewport scene_of(int width, int height, bool panels, bool ecg) {
  const int bottom = panels && ecg ? strip_height : 0;
  return {0, bottom, std::max(16, width - (panels ? panel_width : 0)), std::max(16, height - bottom)};
}

/// In the pixels of the framebuffer, of which a window's unit may have several.
glview::Viewport in_pixels(const glview::Viewport& part) {
  const ImVec2 scale = ImGui::GetIO().DisplayFramebufferScale;
  const auto px = [](int units, float each) {
    return static_cast<int>(std::lround(static_cast<double>(units) * static_cast<double>(each)));
  };
  return {px(part.x, scale.x), px(part.y, scale.y), px(part.width, scale.x), px(part.height, scale.y)};
}

int next(SurfaceValue value) {
  return (static_cast<int>(value) + 1) % static_cast<int>(glview::all_values.size());
}

}  // namespace

const std::vector<NamedView>& named_views() {
  static const std::vector<NamedView> views{{"AP", {0, 0}},
                                            {"LAO 30 CRA 20", {30, 20}},
                                            {"RAO 30", {-30, 0}},
                                            {"RAO 30 CAU 25", {-30, -25}},
                                            {"RAO 20 CRA 35", {-20, 35}},
                                            {"LAO 45 CAU 30", {45, -30}},
                                            {"LAO 50 CRA 30", {50, 30}},
                                            {"LAT (LAO 90)", {90, 0}}};
  return views;
}

Viewer::Viewer(LiveHeart heart, const Options& options)
    : places_(std::move(heart.places)),
      aspect_(scene_of(options.width, options.height, options.panels, heart.input.ecg.has_value()).aspect()),
      playback_(feed_of(heart.input), options.start_s),
      notices_(std::move(heart.input.warnings)),
      scene_(heart.surface, heart.cage),
      colors_(std::move(heart.surface), std::move(heart.cage)) {
  if (!colors_.surface().closed) {
    notice("the surface cannot be closed: its X-ray projection has streaks");
    core::log_warning(notices_.back());
  }
  shown_.panels = options.panels;
  shown_.camera = glview::camera_on(places_, options.view, aspect_);
  if (options.x_ray) shown_.camera.projection = glview::Projection::x_ray;
  set_value(options.value);
  playback_.set_speed(options.speed);
  if (options.phase) playback_.scrub(*options.phase);
}

void Viewer::set_value(SurfaceValue value) {
  shown_.value = value;
  show_value();
}

void Viewer::show_value() {
  const auto& range = ranges_[static_cast<std::size_t>(shown_.value)];
  const bool plain = shown_.value == SurfaceValue::none;
  shown_.look.value = range ? shown_.value : SurfaceValue::none;
  shown_.look.range = range.value_or(glview::ValueRange{});
  if (!plain && !range) colors_.ask(shown_.value);
}

void Viewer::take_color() {
  SurfaceValue value = shown_.value;
  try {
    const SurfaceColors::Found found = colors_.take();
    value = found.value;
    if (!found.along.empty()) scene_.set_directions(found.along);
    if (found.bending) scene_.set_bending(*found.bending);
    ranges_[static_cast<std::size_t>(value)] = found.range;
  } catch (const ResourceError& error) {  // no room for a table on the graphics card
    notice(std::string("this colour cannot be shown: ") + error.what());
    core::log_warning(notices_.back());
    if (shown_.value == value) shown_.value = SurfaceValue::none;
  }
  show_value();
}

void Viewer::settle() {
  while (colors_.busy()) take_color();
}

void Viewer::look_from(const glview::CarmAngles& angles) {
  const auto projection = shown_.camera.projection;
  shown_.camera = glview::camera_on(places_, angles, aspect_);
  shown_.camera.projection = projection;
}

bool Viewer::key(int key, bool shift) {
  Playback& play = playback_;
  if (key >= GLFW_KEY_1 && key < GLFW_KEY_1 + static_cast<int>(named_views().size()))
    look_from(named_views()[static_cast<std::size_t>(key - GLFW_KEY_1)].angles);
  switch (key) {
    case GLFW_KEY_ESCAPE:
      if (!shown_.help) return true;
      shown_.help = false;
      break;
    case GLFW_KEY_Q:
      return true;
    case GLFW_KEY_SPACE:
      play.pause(!play.paused());
      break;
    case GLFW_KEY_LEFT:
      play.scrub(play.phase() - (shift ? 10.0 : 1.0) * phase_step);
      break;
    case GLFW_KEY_RIGHT:
      play.scrub(play.phase() + (shift ? 10.0 : 1.0) * phase_step);
      break;
    case GLFW_KEY_UP:
      play.set_speed(play.speed() * 1.25);
      break;
    case GLFW_KEY_DOWN:
      play.set_speed(play.speed() / 1.25);
      break;
    case GLFW_KEY_PAGE_UP:
      play.seek(play.stream_s() - seek_step_s);
      break;
    case GLFW_KEY_PAGE_DOWN:
      play.seek(play.stream_s() + seek_step_s);
      break;
    case GLFW_KEY_HOME:
      look_from(shown_.camera.angles);
      break;
    case GLFW_KEY_BACKSPACE:
      play.set_speed(1.0);
      break;
    case GLFW_KEY_C:
      set_value(static_cast<SurfaceValue>(next(shown_.value)));
      break;
    case GLFW_KEY_E:
      play.follow_ecg(!play.follows_ecg());
      break;
    case GLFW_KEY_X:
      shown_.camera.projection = shown_.camera.projection == glview::Projection::lit
                                     ? glview::Projection::x_ray
                                     : glview::Projection::lit;
      break;
    case GLFW_KEY_S:
      wishes_.screenshot = true;
      break;
    case GLFW_KEY_TAB:
      shown_.panels = !shown_.panels;
      break;
    case GLFW_KEY_F1:
    case GLFW_KEY_H:
      shown_.help = !shown_.help;
      break;
    default:
      break;
  }
  return false;
}

void Viewer::mouse(const glview::Viewport& scene, int height) {
  const ImGuiIO& io = ImGui::GetIO();
  const double x = static_cast<double>(io.MousePos.x), y = height - static_cast<double>(io.MousePos.y);
  const bool over = !io.WantCaptureMouse && x >= scene.x && x < scene.x + scene.width && y >= scene.y &&
                    y < scene.y + scene.height;
  const bool down = io.MouseDown[0] || io.MouseDown[1] || io.MouseDown[2];
  if (!down) grabbed_ = false;
  const bool clicked = ImGui::IsMouseClicked(0) || ImGui::IsMouseClicked(1) || ImGui::IsMouseClicked(2);
  if (over && clicked) grabbed_ = true;
  glview::Camera& camera = shown_.camera;
  if (over && io.MouseWheel != 0.0F)
    camera = glview::enlarged(camera, std::pow(zoom_step, static_cast<double>(io.MouseWheel)));
  if (!grabbed_ || clicked) return;  // the way to where it is grabbed is none of it
  const double right = static_cast<double>(io.MouseDelta.x), up = -static_cast<double>(io.MouseDelta.y);
  if (io.MouseDown[2] || (io.MouseDown[0] && io.KeyShift))
    camera = glview::shifted(camera, right, up, scene.height);
  else if (io.MouseDown[0])
    camera = glview::turned(camera, right, up, scene.height);
  else
    camera = glview::enlarged(camera, std::pow(zoom_step, up / 20.0));
}

void Viewer::draw(int width, int height, double frames_per_second) {
  if (colors_.ready()) take_color();
  ImGui_ImplOpenGL3_NewFrame();
  ImGui::NewFrame();
  const glview::Viewport scene = scene_of(width, height, shown_.panels, playback_.has_ecg());
  aspect_ = scene.aspect();
  mouse(scene, height);
  if (shown_.panels) {
    PanelTalk talk{shown_,
                   playback_,
                   wishes_,
                   notices_,
                   frames_per_second,
                   [this](const glview::CarmAngles& angles) { look_from(angles); },
                   [this](SurfaceValue value) { set_value(value); }};
    draw_panel(talk, width, height);
    if (playback_.has_ecg()) draw_ecg_strip(playback_, scene.width, height);
  }
  draw_scene_texts(shown_, playback_, scene, height);
  if (shown_.help) draw_help(scene);
  ImGui::Render();
  scene_.set_phase(playback_.phase(), playback_.interval_s());
  scene_.draw(shown_.camera, shown_.look, in_pixels(scene));
  if (shown_.panels) {
    glview::fill(in_pixels({scene.width, 0, width - scene.width, height}), panel_background);
    // the lit tree has filled it already
    if (shown_.camera.projection == glview::Projection::x_ray)
      glview::fill(in_pixels({0, 0, scene.width, scene.y}), glview::scene_backdrop);
  }
  ImGui_ImplOpenGL3_RenderDrawData(ImGui::GetDrawData());
}

Wishes Viewer::take_wishes() {
  const Wishes wishes = wishes_;
  wishes_ = {};
  return wishes;
}

}  // namespace ostia::live
