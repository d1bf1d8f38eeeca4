#include "ostia/view/profile_pointer.h"

#include "pointer/measure_placing.h"

#include <utility>

namespace ostia::view {

class ProfilePointer::Held {
 public:
  Held(ProfileView& view, const HandleHit& hit, const Vec2& pressed)
      : view_(view),
        start_(pressed),
        end_(view.bench(), hit),
        grip_px_(view.x_of(end_.s_mm()) - pressed.x()) {}
  void move(const Vec2& px) {
    if (!moved_ && (px - start_).norm() < trembling_units * view_.density()) return;
    moved_ = true;
    if (const std::optional<double> s = view_.abscissa_at(px.x() + grip_px_)) end_.pull_to(*s);
  }
  void take_back() { end_.take_back(); }

 private:
  ProfileView& view_;
  Vec2 start_;
  HeldEnd end_;
  double grip_px_;  // from the hand to the end
  bool moved_ = false;
};

ProfilePointer::ProfilePointer(ProfileView& view) : view_(view) {
  session::Workbench& bench = view.bench();
  own_.push_back(bench.case_changed.observe([this] { let_go(); }));
  own_.push_back(bench.image_changed.observe([this] { let_go(); }));
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) { let_go(); }));
}
ProfilePointer::~ProfilePointer() = default;

std::optional<HandleHit> ProfilePointer::handle_near(const Vec2& px) const {
  return view_.handle_near(px, handle_reach_units * view_.density());
}

void ProfilePointer::go_to(const Vec2& px) {
  if (const std::optional<double> s = view_.abscissa_at(px.x()))
    view_.bench().cursor_mm.set(view_.bench().here_mm(*s));
}

void ProfilePointer::hover(const Vec2& px) {
  shape_ = handle_near(px) ? CursorShape::grab : CursorShape::arrow;
}

void ProfilePointer::press(const PointerEvent& event) {
  if (held_ || walking_) return;
  const std::optional<HandleHit> hit =
      event.button == Button::left ? handle_near(event.px) : std::optional<HandleHit>();
  if (hit) {
    held_ = std::make_shared<Held>(view_, *hit, event.px);
    shape_ = CursorShape::grab;
    return;
  }
  walking_ = event.button == Button::left;
  go_to(event.px);
}

void ProfilePointer::move(const PointerEvent& event) {
  if (const std::shared_ptr<Held> held = held_)
    held->move(event.px);
  else if (walking_)
    go_to(event.px);
  else
    hover(event.px);
}

void ProfilePointer::release(const PointerEvent& event) {
  if (event.button != Button::left) return;
  walking_ = false;
  if (const std::shared_ptr<Held> ended = std::exchange(held_, nullptr)) ended->move(event.px);
  hover(event.px);
}

void ProfilePointer::let_go() {
  walking_ = false;
  held_.reset();
}

void ProfilePointer::cancel() {
  const std::shared_ptr<Held> begun = held_;
  let_go();
  if (begun) begun->take_back();
}

bool ProfilePointer::erase(const PointerEvent& event) {
  const std::optional<HandleHit> hit = handle_near(event.px);
  if (!hit) return false;
  held_.reset();
  view_.bench().annotate(session::MeasureDelete{hit->measurement});
  return true;
}

}  // namespace ostia::view
