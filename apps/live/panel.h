#pragma once
/// \file The panel beside the scene, the texts in it, the help.

#include "viewer.h"

#include <functional>

namespace ostia::live {

inline constexpr int panel_width = 250, strip_height = 150;

struct PanelTalk {
  Shown& shown;
  Playback& playback;
  Wishes& wishes;
  std::vector<std::string>& notices;
  double frames_per_second;
  std::function<void(const glview::CarmAngles&)> look_from;
  std::function<void(glview::SurfaceValue)> set_value;
};

void draw_panel(PanelTalk& talk, int width, int height);
/// The view's angles, the phase, the bar of colours.
void draw_scene_texts(const Shown& shown, const Playback& playback, const glview::Viewport& scene,
                      int height);
void draw_help(const glview::Viewport& scene);

}  // namespace ostia::live
