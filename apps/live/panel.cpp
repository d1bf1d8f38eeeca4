#include "panel.h"

#include "look_of_windows.h"

#include <imgui.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

namespace ostia::live {
namespace {

using glview::SurfaceValue;

constexpr std::array<std::array<const char*, 2>, 17> keys{{{"drag", "turn, as a C-arm is"},
                                                           {"Shift + drag", "move"},
                                                           {"wheel", "larger, smaller"},
                                                           {"1 to 8", "named views"},
                                                           {"Home", "all in the picture"},
                                                           {"X", "X-ray projection"},
                                                           {"C", "next colour"},
                                                           {"Space", "pause, go on"},
                                                           {"Left, Right", "phase by 1 % (Shift: 10 %)"},
                                                           {"Up, Down", "faster, slower"},
                                                           {"Backspace", "recorded speed"},
                                                           {"Page Up, Down", "5 s of the ECG"},
                                                           {"E", "by the ECG, in a loop"},
                                                           {"S", "screenshot"},
                                                           {"Tab", "panels away"},
                                                           {"H", "this help"},
                                                           {"Q", "quit"}}};

ImVec4 color_of(Concern concern) {
  switch (concern) {
    case Concern::none:
      return good_color;
    case Concern::attention:
      return attention_color;
    case Concern::trouble:
      return trouble_color;
  }
  return good_color;
}

void line_of(const StateText& state) {
  if (state.text.empty()) return;
  const ImVec2 at = ImGui::GetCursorScreenPos();
  const float height = ImGui::GetTextLineHeight();
  ImGui::GetWindowDrawList()->AddCircleFilled({at.x + 5.0F, at.y + height / 2.0F}, 4.5F,
                                              ImGui::ColorConvertFloat4ToU32(color_of(state.concern)));
  ImGui::SetCursorScreenPos({at.x + 16.0F, at.y});
  ImGui::TextWrapped("%s", state.text.c_str());
}

void heading(const char* text) {
  ImGui::Dummy({0.0F, 5.0F});
  ImGui::TextColored(muted_color, "%s", text);
  ImGui::Separator();
}

void draw_time(PanelTalk& talk) {
  Playback& play = talk.playback;
  heading("HEART");
  char large[64];
  std::snprintf(large, sizeof(large), "%.0f /min", 60.0 / play.interval_s());
  const bool known = !play.follows_ecg() || play.feed()->phase().interval_s > 0.0;
  ImGui::SetWindowFontScale(1.5F);
  ImGui::Text("%s", known ? large : "-- /min");
  ImGui::SetWindowFontScale(1.0F);
  line_of(play.state());
  line_of(play.signal());
  if (ImGui::Button(play.paused() ? "Go on" : "Pause", {110.0F, 0.0F})) play.pause(!play.paused());
  if (play.has_ecg()) {
    ImGui::SameLine();
    if (ImGui::Button(play.follows_ecg() ? "Loop" : "By the ECG", {-1.0F, 0.0F}))
      play.follow_ecg(!play.follows_ecg());
  }
  float phase = static_cast<float>(100.0 * play.phase());
  ImGui::SetNextItemWidth(-70.0F);
  if (ImGui::SliderFloat("phase", &phase, 0.0F, 99.9F, "%.1f %%"))
    play.scrub(static_cast<double>(phase) / 100.0);
  float speed = static_cast<float>(play.speed());
  ImGui::SetNextItemWidth(-70.0F);
  if (ImGui::SliderFloat("speed", &speed, 0.1F, 4.0F, "%.2f x", ImGuiSliderFlags_Logarithmic))
    play.set_speed(static_cast<double>(speed));
  if (play.follows_ecg()) return;
  float rate = static_cast<float>(60.0 / play.loop_interval_s());
  ImGui::SetNextItemWidth(-70.0F);
  if (ImGui::SliderFloat("beats", &rate, 30.0F, 180.0F, "%.0f /min"))
    play.set_loop_interval(60.0 / static_cast<double>(rate));
}

void draw_views(PanelTalk& talk) {
  heading("VIEW");
  bool x_ray = talk.shown.camera.projection == glview::Projection::x_ray;
  if (ImGui::Checkbox("X-ray projection", &x_ray))
    talk.shown.camera.projection = x_ray ? glview::Projection::x_ray : glview::Projection::lit;
  if (x_ray) {
    float absorption = static_cast<float>(talk.shown.look.absorption_per_mm);
    ImGui::SetNextItemWidth(-70.0F);
    if (ImGui::SliderFloat("contrast", &absorption, 0.05F, 1.5F, "%.2f /mm", ImGuiSliderFlags_Logarithmic))
      talk.shown.look.absorption_per_mm = static_cast<double>(absorption);
  }
  const auto& views = named_views();
  for (std::size_t i = 0; i < views.size(); ++i) {
    if (i % 2 == 1) ImGui::SameLine();
    if (ImGui::Button(views[i].name, {(panel_width - 32.0F) / 2.0F, 0.0F})) talk.look_from(views[i].angles);
  }
}

void draw_colors(PanelTalk& talk) {
  heading("COLOUR");
  for (const SurfaceValue value : glview::all_values)
    if (ImGui::RadioButton(glview::title(value), talk.shown.value == value)) talk.set_value(value);
}

}  // namespace

void draw_panel(PanelTalk& talk, int width, int height) {
  ImGui::SetNextWindowPos({static_cast<float>(width - panel_width), 0.0F});
  ImGui::SetNextWindowSize({static_cast<float>(panel_width), static_cast<float>(height)});
  ImGui::Begin("panel", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoBackground | ImGuiWindowFlags_NoMove |
                   ImGuiWindowFlags_NoNav | ImGuiWindowFlags_NoBringToFrontOnFocus);
  draw_time(talk);
  draw_views(talk);
  draw_colors(talk);
  ImGui::Dummy({0.0F, 5.0F});
  if (ImGui::Button("Screenshot", {110.0F, 0.0F})) talk.wishes.screenshot = true;
  ImGui::SameLine();
  if (ImGui::Button("Help", {-1.0F, 0.0F})) talk.shown.help = !talk.shown.help;
  if (talk.frames_per_second > 0.0)
    ImGui::TextColored(muted_color, "%.0f pictures/s", talk.frames_per_second);
  // The last ones: the newest is what a person has just asked for.
  const std::size_t first = talk.notices.size() > 3 ? talk.notices.size() - 3 : 0;
  for (std::size_t i = first; i < talk.notices.size(); ++i) {
    ImGui::Separator();
    ImGui::PushStyleColor(ImGuiCol_Text, attention_color);
    ImGui::TextWrapped("%s", talk.notices[i].c_str());
    ImGui::PopStyleColor();
  }
  ImGui::End();
}

namespace {

void draw_bar(const Shown& shown, const glview::Viewport& scene, float top) {
  const SurfaceValue value = shown.value;
  if (value == SurfaceValue::none || shown.camera.projection == glview::Projection::x_ray) return;
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const float x = 18.0F, wide = 14.0F, high = std::min(260.0F, 0.45F * static_cast<float>(scene.height));
  draw.AddText({x, top}, text_color, glview::title(value));
  top += 24.0F;
  if (shown.look.value != value) {
    draw.AddText({x, top}, muted_mark, "is being prepared");
    return;
  }
  constexpr int steps = 64;
  for (int i = 0; i < steps; ++i) {
    const figure::Color c = glview::color(value, 1.0 - (i + 0.5) / steps);
    draw.AddRectFilled({x, top + high * static_cast<float>(i) / steps},
                       {x + wide, top + high * static_cast<float>(i + 1) / steps},
                       ImGui::ColorConvertFloat4ToU32({static_cast<float>(c.r), static_cast<float>(c.g),
                                                       static_cast<float>(c.b), 1.0F}));
  }
  for (int i = 0; i <= 4; ++i) {
    const double number = shown.look.range.high - (shown.look.range.high - shown.look.range.low) * i / 4.0;
    char text[32];
    std::snprintf(text, sizeof(text), "%s%.3g", is_signed(value) && number > 0.0 ? "+" : "", number);
    const float y = top + high * static_cast<float>(i) / 4.0F;
    draw.AddLine({x + wide, y}, {x + wide + 4.0F, y}, text_color);
    draw.AddText({x + wide + 8.0F, y - ImGui::GetTextLineHeight() / 2.0F}, text_color, text);
  }
}

}  // namespace

void draw_scene_texts(const Shown& shown, const Playback& playback, const glview::Viewport& scene,
                      int height) {
  ImDrawList& draw = *ImGui::GetForegroundDrawList();
  const float top = static_cast<float>(height - scene.y - scene.height) + 14.0F;
  const ImU32 ink = shown.camera.projection == glview::Projection::x_ray ? ink_on_grey : text_color;
  draw.AddText(nullptr, 1.25F * ImGui::GetFontSize(), {18.0F, top}, ink,
               glview::text_of(shown.camera.angles).c_str());
  char text[64];
  std::snprintf(text, sizeof(text), "phase %.0f %%", 100.0 * playback.phase());
  draw.AddText({18.0F, top + 24.0F}, ink, text);
  draw_bar(shown, scene, top + 60.0F);
  // A scale, exact at the isocentre: 10 mm.
  const float px = static_cast<float>(10.0 * scene.height / (2.0 * shown.camera.half_height_mm));
  const float y = static_cast<float>(height - scene.y) - 18.0F,
              right = static_cast<float>(scene.width) - 18.0F;
  draw.AddLine({right - px, y}, {right, y}, ink, 2.0F);
  draw.AddText({right - px, y - 22.0F}, ink, "10 mm");
}

void draw_help(const glview::Viewport& scene) {
  ImGui::SetNextWindowPos({static_cast<float>(scene.width) / 2.0F, static_cast<float>(scene.height) / 2.0F},
                          ImGuiCond_Always, {0.5F, 0.5F});
  ImGui::Begin("help", nullptr,
               ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove | ImGuiWindowFlags_AlwaysAutoResize);
  if (ImGui::BeginTable("keys", 2)) {
    for (const auto& [key, what] : keys) {
      ImGui::TableNextColumn();
      ImGui::TextColored(accent_color, "%s", key);
      ImGui::TableNextColumn();
      ImGui::Text("%s", what);
    }
    ImGui::EndTable();
  }
  ImGui::End();
}

}  // namespace ostia::live
