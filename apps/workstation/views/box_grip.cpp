#include "views/box_grip.h"

#include "views/heart_volume.h"
#include "views/scene_drag.h"
#include "views/scene_widget.h"

#include <utility>

namespace ostia::workstation {
namespace {

constexpr double handle_units = 10.0;

}  // namespace

BoxGrip::BoxGrip(HeartVolume& heart, SceneWidget& scene) : QObject(&heart), heart_(heart), scene_(scene) {
  const auto changed = [this](const auto&...) { refresh(); };
  own_.push_back(heart.crop.observe(changed));
  own_.push_back(heart.box_shown.observe(changed));
  connect(&heart, &HeartVolume::shown_changed, this, &BoxGrip::refresh);
  connect(&scene, &SceneWidget::volume_mode_changed, this, &BoxGrip::refresh);
}

bool BoxGrip::is_there() const {
  return heart_.box_shown.get() && heart_.shown() && scene_.volume_mode() != view::VolumeMode::off;
}

std::array<view::BoxFace, 6> BoxGrip::faces() const {
  return view::faces_of(heart_.crop.get(), heart_.shown()->geometry);
}

void BoxGrip::refresh() {
  view::SceneFrame frame;
  const bool there = is_there();
  if (there) {
    frame.lines = view::edges_of(heart_.crop.get(), heart_.shown()->geometry);
    for (const view::BoxFace& face : faces()) frame.grips.push_back(face.middle);
    if (taken_) frame.held = static_cast<int>(taken_->face);
  } else {
    taken_.reset();
  }
  scene_.scene().set_frame(std::move(frame));
  scene_.request_render();
  if (there && !scene_.grip()) scene_.set_grip(this);  // a mesh that was cut has let go of it
  if (there == in_hand_) return;
  in_hand_ = there;
  if (scene_.grip() && scene_.grip()->draws()) scene_.grip()->put_back();  // scissors: one at a time
  if (there) {
    former_ = scene_.grip() == this ? nullptr : scene_.grip();
    scene_.set_grip(this);
  } else if (scene_.grip() == this) {
    scene_.set_grip(former_);
  }
}

std::optional<std::size_t> BoxGrip::face_at(const geometry::Vec2& display) const {
  if (!is_there()) return std::nullopt;
  std::optional<std::size_t> found;
  constexpr double same_px = 1.0;
  double nearest = handle_units * scene_.scene().pixel_ratio();
  const auto all = faces();
  const geometry::Vec3 towards = scene_.scene().pose().towards;
  for (std::size_t n = 0; n < all.size(); ++n) {
    const double away = (scene_.scene().project(all[n].middle) - display).norm();
    const bool before = found && (all[n].middle - all[*found].middle).dot(towards) > 0.0;
    // Of two that lie one behind the other the one that is seen.
    if (away < nearest - same_px || (before && away < nearest + same_px) || (!found && away < nearest)) {
      nearest = away;
      found = n;
    }
  }
  return found;
}

bool BoxGrip::under(const geometry::Vec2& display) const {
  return face_at(display).has_value();
}

void BoxGrip::take(const geometry::Vec2& display) {
  if (const auto face = face_at(display)) taken_ = Taken{*face, faces()[*face], heart_.crop.get(), display};
  refresh();
}

void BoxGrip::drag(const geometry::Vec2& display) {
  if (!taken_) return;
  const view::BoxFace& face = taken_->as_taken;
  const double mm = dragged_mm(scene_.scene(), face.middle, face.towards, taken_->at, display);
  heart_.crop.set(view::with_face_moved(taken_->crop, face, mm));
}

void BoxGrip::put_back() {
  if (const auto was = std::exchange(taken_, std::nullopt)) heart_.crop.set(was->crop);
  refresh();
}

void BoxGrip::let_go() {
  taken_.reset();
  refresh();
}

}  // namespace ostia::workstation
