#include "pointer/measure_marks.h"
#include "pointer/pointer_gestures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::view {
namespace {

constexpr double outline_step_units = 3.0;

void show_line(PictureView& view, std::vector<Vec2> px) {
  Overlay overlay;
  for (const Vec2& p : {px.front(), px.back()}) overlay.marks.push_back({p, Role::selected, 3.5, 1.0, false});
  overlay.lines.push_back({std::move(px), Role::selected});
  view.set_tool_overlay(std::move(overlay));
}

void show_stretch(CurvedView& view, double from_mm, double to_mm) {
  Overlay overlay;
  const double a = view.row_of(from_mm), b = view.row_of(to_mm), w = view.width();
  overlay.lines.push_back({{Vec2(0, a), Vec2(w, a)}, Role::reference, 1.0, true});
  overlay.lines.push_back({{Vec2(0, b), Vec2(w, b)}, Role::reference, 1.0, true});
  overlay.bands.push_back({Vec2(0, std::min(a, b)), Vec2(w, std::max(a, b)), Role::reference, 0.12});
  view.set_tool_overlay(std::move(overlay));
}

}  // namespace

Pointer::TwoPoints::TwoPoints(PictureView& view, const PointerEvent& event, analysis::MeasureKind kind)
    : view_(view), kind_(kind), start_(event.px), end_(event.px) {}
void Pointer::TwoPoints::move(const PointerEvent& event) {
  end_ = event.px;
  show_line(view_, {start_, end_});
}
void Pointer::TwoPoints::release(const PointerEvent& event) {
  end_ = event.px;
  view_.set_tool_overlay({});
  const std::optional<Vec3> a = view_.world(start_), b = view_.world(end_);
  if (!a || !b || (end_ - start_).norm() < trembling_units * view_.density()) return;
  session::Workbench& bench = view_.bench();
  add_measurement(
      bench, of_points(kind_, {*a, *b}, kind_ == analysis::MeasureKind::diameter ? bench.vessel.get() : 0));
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
  std::vector<Vec3> points;
  for (const Vec2& p : px_)
    if (const std::optional<Vec3> place = view_.world(p)) points.push_back(*place);
  if (points.size() >= 3)
    add_measurement(view_.bench(), of_points(analysis::MeasureKind::area, std::move(points)));
}
void Pointer::Outline::cancel() {
  view_.set_tool_overlay({});
}

Pointer::Stretch::Stretch(CurvedView& view, const PointerEvent& event, analysis::MeasureKind kind)
    : view_(view), kind_(kind), from_mm_(view.abscissa_at(event.px.y())), to_mm_(from_mm_) {}
void Pointer::Stretch::move(const PointerEvent& event) {
  to_mm_ = view_.abscissa_at(event.px.y());
  show_stretch(view_, from_mm_, to_mm_);
}
void Pointer::Stretch::release(const PointerEvent& event) {
  move(event);
  view_.set_tool_overlay({});
  if (std::abs(view_.row_of(to_mm_) - view_.row_of(from_mm_)) < trembling_units * view_.density()) return;
  add_measurement(view_.bench(), of_stretch(kind_, view_.bench().vessel.get(), from_mm_, to_mm_));
}
void Pointer::Stretch::cancel() {
  view_.set_tool_overlay({});
}

Pointer::MoveHandle::MoveHandle(PictureView& view, const PointerEvent& event, const HandleHit& hit)
    : view_(view), start_(event.px), held_(view.bench(), hit.measurement), point_(hit.handle) {}
void Pointer::MoveHandle::move(const PointerEvent& event) {
  if (!moved_ && (event.px - start_).norm() < trembling_units * view_.density()) return;
  moved_ = true;
  const std::optional<Vec3> to = view_.world(event.px);
  if (!to || point_ >= held_.now().points.size()) return;
  analysis::Measurement next = held_.now();
  next.points[point_] = *to;
  held_.become(std::move(next));
}

Pointer::MoveEnd::MoveEnd(CurvedView& view, const PointerEvent& event, const HandleHit& hit)
    : view_(view),
      start_(event.px),
      held_(view.bench(), hit),
      grip_px_(view.row_of(held_.s_mm()) - event.px.y()) {}
void Pointer::MoveEnd::move(const PointerEvent& event) {
  if (!moved_ && (event.px - start_).norm() < trembling_units * view_.density()) return;
  moved_ = true;
  held_.pull_to(view_.abscissa_at(event.px.y() + grip_px_));
  const std::vector<double> ends = ends_of(held_.now());
  show_stretch(view_, ends.front(), ends.back());
}
void Pointer::MoveEnd::cancel() {
  view_.set_tool_overlay({});
}

bool Pointer::measuring_click(const PointerEvent& event, const Vec3& place) {
  session::Workbench& bench = view_.bench();
  if (bench.tool.get() == session::Tool::angle) {
    clicked_.push_back(place);
    if (clicked_.size() == 3) {
      view_.set_tool_overlay({});
      add_measurement(bench, of_points(analysis::MeasureKind::angle, std::exchange(clicked_, {})));
    } else {
      show_clicked();
    }
    return true;
  }
  if (bench.tool.get() == session::Tool::ring_hu) {
    auto* curved = dynamic_cast<CurvedView*>(&view_);
    add_measurement(bench, ring_at(bench.vessel.get(),
                                   curved ? curved->abscissa_at(event.px.y()) : bench.cursor_mm.get()));
    return true;
  }
  if (bench.tool.get() == session::Tool::note) {
    add_measurement(bench, of_points(analysis::MeasureKind::note, {place}));
    return true;
  }
  return false;
}

void Pointer::show_clicked() {
  Overlay overlay;
  OverlayLine line;
  line.role = Role::selected;
  for (const Vec3& place : clicked_)
    if (const auto shown = view_.project(place)) {
      line.px.push_back(shown->px);
      overlay.marks.push_back({shown->px, Role::selected, 3.5, 1.0, false});
    }
  if (line.px.size() > 1) overlay.lines.push_back(std::move(line));
  view_.set_tool_overlay(std::move(overlay));
}

}  // namespace ostia::view
