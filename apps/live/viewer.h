#pragma once
/// \file The whole picture: scene, panel, strip; and what keys and the mouse do. Knows no window.

#include "frame_meter.h"
#include "live_heart.h"
#include "playback.h"
#include "surface_colors.h"

#include "ostia/glview/beating_scene.h"

#include <array>
#include <string>
#include <vector>

namespace ostia::live {

/// What is shown, as far as a person chooses it.
struct Shown {
  glview::Camera camera;
  glview::SceneLook look;  ///< its value is the chosen one when that is ready
  glview::SurfaceValue value = glview::SurfaceValue::none;  ///< that was chosen
  bool panels = true, help = false;
};

/// What the panel asks for beyond what it sets itself.
struct Wishes {
  bool screenshot = false, whole_view = false;
};

/// A view of the catheter laboratory, and what it shows best.
struct NamedView {
  const char* name;
  glview::CarmAngles angles;
};
const std::vector<NamedView>& named_views();

class Viewer {
 public:
  /// The contexts of OpenGL and of Dear ImGui are current, here and in all calls.
  Viewer(LiveHeart heart, const Options& options);

  /// A key of GLFW's. True where it asks for the end.
  bool key(int key, bool shift);
  /// Moves on by seconds of the wall's clock; returns how many samples came in.
  std::size_t advance(double seconds) { return playback_.advance(seconds); }
  /// Draws into what is bound: a window of this size, which has Dear ImGui's DisplayFramebufferScale times as
  /// many pixels. The platform's part of Dear ImGui's frame has begun.
  void draw(int width, int height, double frames_per_second);

  /// Waits until the colour that was chosen is ready, as pictures without a window do.
  void settle();

  Wishes take_wishes();
  const Playback& playback() const { return playback_; }
  Playback& playback() { return playback_; }
  const Shown& shown() const { return shown_; }
  void notice(std::string text) { notices_.push_back(std::move(text)); }  ///< in the window

 private:
  void mouse(const glview::Viewport& scene, int height);
  void look_from(const glview::CarmAngles& angles);
  void set_value(glview::SurfaceValue value);
  void show_value();                    ///< the one that was chosen, or, as long as that takes, none
  void take_color();                    ///< that is ready
  std::vector<geometry::Vec3> places_;  // of the surface over the cycle
  double aspect_;
  Playback playback_;
  std::array<std::optional<glview::ValueRange>, glview::all_values.size()> ranges_;
  std::vector<std::string> notices_;
  Shown shown_;
  Wishes wishes_;
  bool grabbed_ = false;  // the mouse, in the scene
  glview::BeatingScene scene_;
  SurfaceColors colors_;
};

}  // namespace ostia::live
