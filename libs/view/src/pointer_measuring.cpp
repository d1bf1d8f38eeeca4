#include "measure_marks.h"
#include "pointer_gestures.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

constexpr double least_units = 3.0;  // shorter is a click that trembled
constexpr double outline_step_units = 3.0;

void show_line(PictureView& view, std::vector<Vec2> px) {
  Overlay overlay;
  for (const Vec2& p : {px.front(), px.back()}) overlay.marks.push_back({p, Role::selected, 3.5, 1.0, false});
  overlay.lines.push_back({std::move(px), Role::selected});
  view.set_tool_overlay(std::move(overlay));
}

}  // namespace

void add_measurement(session::Workbench& bench, analysis::Measurement made) {
  const session::Session::Done done = bench.annotate(session::MeasureAdd{std::move(made)});
  if (!done.annotations.measurements.empty())
    bench.selected_measurement.set(done.annotations.measurements.front());
}

Pointer::TwoPoints::TwoPoints(PictureView& view, const PointerEvent& event, analysis::MeasureKind kind)
    : view_(view), start_(event.px), end_(event.px) {
  made_.kind = kind;
  if (kind == analysis::MeasureKind::diameter) made_.vessel = view.bench().vessel.get();
}
void Pointer::TwoPoints::move(const PointerEvent& event) {
  end_ = event.px;
  show_line(view_, {start_, end_});
}
void Pointer::TwoPoints::release(const PointerEvent& event) {
  end_ = event.px;
  view_.set_tool_overlay({});
  const std::optional<Vec3> a = view_.world(start_), b = view_.world(end_);
  if (!a || !b || (end_ - start_).norm() < least_units * view_.density()) return;
  made_.points = {*a, *b};
  add_measurement(view_.bench(), made_);
}
void Pointer::TwoPoints::cancel() {
  view_.set_tool_overlay({});
}

Pointer::Outline::Outline(PictureView& view, const PointerEvent& event) : view_(view), px_{event.px} {}
void Pointer::Outline::move(const PointerEvent& event) {
  if ((px_.back() - event.px).norm() >= outline_step_units * view_.density()) px_.push_back(event.px);
  std::vector<Vec2> closed = px_;
  closed.push_back(px_.front());
  show_line(view_, std::move(closed));
}
void Pointer::Outline::release(const PointerEvent& event) {
  move(event);
  view_.set_tool_overlay({});
  if (px_.size() < 3) return;
  analysis::Measurement made;
  made.kind = analysis::MeasureKind::area;
  for (const Vec2& p : px_)
    if (const std::optional<Vec3> place = view_.world(p)) made.points.push_back(*place);
  if (made.points.size() >= 3) add_measurement(view_.bench(), std::move(made));
}
void Pointer::Outline::cancel() {
  view_.set_tool_overlay({});
}

Pointer::Stretch::Stretch(CurvedView& view, const PointerEvent& event, analysis::MeasureKind kind)
    : view_(view), kind_(kind), from_mm_(view.abscissa_at(event.px.y())), to_mm_(from_mm_) {}
void Pointer::Stretch::move(const PointerEvent& event) {
  to_mm_ = view_.abscissa_at(event.px.y());
  Overlay overlay;
  const double a = view_.row_of(from_mm_), b = view_.row_of(to_mm_), w = view_.width();
  overlay.lines.push_back({{Vec2(0, a), Vec2(w, a)}, Role::reference, 1.0, true});
  overlay.lines.push_back({{Vec2(0, b), Vec2(w, b)}, Role::reference, 1.0, true});
  overlay.bands.push_back({Vec2(0, std::min(a, b)), Vec2(w, std::max(a, b)), Role::reference, 0.12});
  view_.set_tool_overlay(std::move(overlay));
}
void Pointer::Stretch::release(const PointerEvent& event) {
  move(event);
  view_.set_tool_overlay({});
  if (std::abs(view_.row_of(to_mm_) - view_.row_of(from_mm_)) < least_units * view_.density()) return;
  analysis::Measurement made;
  made.kind = kind_;
  made.vessel = view_.bench().vessel.get();
  made.from_mm = std::min(from_mm_, to_mm_);
  made.to_mm = std::max(from_mm_, to_mm_);
  add_measurement(view_.bench(), std::move(made));
}
void Pointer::Stretch::cancel() {
  view_.set_tool_overlay({});
}

Pointer::MoveHandle::MoveHandle(PictureView& view, const PictureView::HandleHit& hit)
    : view_(view), point_(hit.point), drag_(new_drag()) {
  if (const auto* found =
          session::find_measurement(*view.bench().session().file().annotations(), hit.measurement))
    changed_ = *found;
  view.bench().selected_measurement.set(hit.measurement);
}
void Pointer::MoveHandle::move(const PointerEvent& event) {
  const std::optional<Vec3> to = view_.world(event.px);
  if (!to || point_ >= changed_.points.size()) return;
  analysis::Measurement next = changed_;
  next.points[point_] = *to;
  view_.bench().annotate_merged(session::MeasureChange{next}, drag_);
  changed_ = std::move(next);
}

}  // namespace ostia::view
