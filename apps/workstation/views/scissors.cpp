#include "views/scissors.h"

#include "views/scene_widget.h"

#include <utility>

namespace ostia::workstation {
namespace {

constexpr double lasso_step_px = 3.0;

}  // namespace

void Scissors::take_up(bool keep_inside) {
  keep_inside_ = keep_inside;
  if (taken_up_) return;
  taken_up_ = true;
  former_ = scene_.grip();
  scene_.set_grip(this);
}

bool Scissors::under(const geometry::Vec2&) const {
  return taken_up_;
}

void Scissors::take(const geometry::Vec2& display) {
  line_ = {display};
}

void Scissors::drag(const geometry::Vec2& display) {
  if (line_.empty() || (display - line_.back()).norm() < lasso_step_px) return;
  line_.push_back(display);
  show();
}

/// A slip of the hand is no line: the scissors stay.
void Scissors::let_go() {
  const std::vector<geometry::Vec2> line = std::exchange(line_, {});
  show();
  if (line.size() < 3) return;
  const view::VolumeCut cut = scene_.scene().cut_along(line, keep_inside_);
  put_back();
  cut_(cut);
}

void Scissors::put_back() {
  line_.clear();
  show();
  if (!taken_up_) return;
  taken_up_ = false;
  if (scene_.grip() == this) scene_.set_grip(former_);
}

void Scissors::show() {
  scene_.scene().set_lasso(line_);
  scene_.request_render();
}

}  // namespace ostia::workstation
