#pragma once
/// \file A vessel tree, its panel, and what keys and the mouse do. Knows no window.

#include "tree_input.h"

#include "ostia/glview/tree_camera.h"
#include "ostia/glview/tree_drawing.h"

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ostia::live {

class TreeViewer {
 public:
  /// The contexts of OpenGL and of Dear ImGui are current, here and in all calls. `input` outlives it.
  TreeViewer(const TreeInput& input, const Options& options);
  bool key(int key);  ///< of GLFW's. True where it asks for the end.
  /// Draws into what is bound, as Viewer::draw.
  void draw(int width, int height, double frames_per_second);
  void turn(double right_px);
  bool take_screenshot_wish();
  void notice(std::string text) { notices_.push_back(std::move(text)); }

  const glview::TreeCamera& eye() const { return eye_; }
  const std::vector<analysis::TreePlace>& picked() const {
    return picked_;
  }  ///< at most two, the last one last
  std::size_t shown_segments() const { return shown_segments_; }
  const geometry::BlockChoice& choice() const { return drawing_.choice(); }
  bool moved() const { return moved_; }  ///< since the last picture

 private:
  void mouse(int width, int height);
  void pick(const geometry::Vec2& place);
  void show_subtree(bool only);
  void go_to_subtree();
  void panel(int width, int height, double frames_per_second);
  void facts();
  void measures();
  void marks(int width, int height);
  void grid();
  const TreeInput& input_;
  glview::TreeDrawing drawing_;
  glview::TreeCamera eye_;
  std::vector<analysis::TreePlace> picked_;
  std::vector<std::uint8_t> shown_;  // empty: all
  std::size_t shown_segments_ = 0;
  std::vector<std::string> notices_;
  std::optional<analysis::SubtreeTotals> within_;
  float region_mm_ = 1.0F;
  bool panels_ = true, help_ = false, grid_ = false, region_ = false;
  bool screenshot_ = false, grabbed_ = false, dragged_ = false, moved_ = true, placed_ = false;
};

}  // namespace ostia::live
