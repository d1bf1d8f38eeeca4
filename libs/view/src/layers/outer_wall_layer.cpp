#include "ostia/view/outer_wall_layer.h"

#include "ostia/view/truth_layer.h"

#include <utility>

namespace ostia::view {

OuterWallLayer::OuterWallLayer(PictureView& view, session::OuterWallBoard& board)
    : view_(view), board_(board) {
  view_.set_layer(
      [this](Overlay& overlay) {
        if (!board_.shown.get()) return;
        for (const std::vector<Vec2>& line : lines())
          overlay.lines.push_back({line, Role::outer_wall, 1.0, true});
      },
      PictureView::LayerPlace::outer_wall);
  own_.push_back(board.shown.observe([this](const bool&) { view_.touch_layer(); }));
  own_.push_back(board.changed.observe([this] { view_.touch_layer(); }));
}
OuterWallLayer::~OuterWallLayer() {
  view_.set_layer({}, PictureView::LayerPlace::outer_wall);
}

const std::vector<std::vector<Vec2>>& OuterWallLayer::lines() {
  const std::uint64_t known = board_.revision(), placed = view_.placement_revision();
  if (made_ && known == known_ && placed == placed_) return lines_;
  lines_.clear();
  if (view_.ready())
    for (const auto& [vessel, one] : board_.known())
      for (std::vector<Vec2>& line : lines_on(view_, one.surface)) lines_.push_back(std::move(line));
  known_ = known;
  placed_ = placed;
  made_ = true;
  return lines_;
}

}  // namespace ostia::view
