#include "pointer/pointer_gestures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

constexpr double on_wall = 0.2;           // |f| of a place that counts as on a vessel's wall
constexpr double least_drag_units = 2.0;  // a click that trembles is no drag
constexpr double stroke_step_units = 2.0;
constexpr double closing_units = 14.0;  // a drawn line that ends so near to its start is closed
constexpr double push_step = 0.25;      // of the ball's radius between places of its path

}  // namespace

std::int32_t vessel_of_wall(const session::Workbench& bench, const Vec3& place) {
  const lumen::LumenModel* model = bench.model();
  if (!model) return session::Workbench::no_vessel;
  const std::int32_t selected = bench.vessel.get();
  const auto value = [&](std::int32_t id) {
    return std::abs(bench.session().live().surface(id)->value(place));
  };
  if (const auto axis = bench.axis()) {
    const double s = axis->nearest_foot(place).s_mm;
    if (value(lumen::owner_at(model->tree, selected, s)) < on_wall) return selected;
  }
  std::int32_t best = selected;
  double least = std::numeric_limits<double>::infinity();
  for (const auto& vessel : model->vessels) {
    const double here = value(vessel->vessel);
    if (here < least) {
      least = here;
      best = vessel->vessel;
    }
  }
  return best;
}

Pointer::Drag::Drag(PictureView& view, const Vec3& taken) : view_(view) {
  edit_.vessel = vessel_of_wall(view.bench(), taken);
  edit_.from = taken;
  edit_.reach_mm = view.bench().reach_mm.get();
}

void Pointer::Drag::move(const PointerEvent& event) {
  const std::optional<ViewPlace> from = view_.project(edit_.from);
  const std::optional<Vec3> to = view_.world(event.px);
  if (!from || !to) return;
  if (!moved_ && (from->px - event.px).norm() < least_drag_units * view_.density()) return;
  edit_.to = *to;
  session::Workbench& bench = view_.bench();
  // The same wall may have been pulled before: that was another step.
  steps_.note(bench, moved_ ? bench.edit_merged(edit_) : bench.edit(edit_));
  moved_ = true;
}

Pointer::Stroke::Stroke(PictureView& view, const PointerEvent& event) : view_(view) {
  add(event.px);
}

void Pointer::Stroke::add(const Vec2& px) {
  if (!px_.empty() && (px_.back() - px).norm() < stroke_step_units * view_.density()) return;
  const std::optional<Vec3> place = view_.world(px);
  if (!place) return;
  px_.push_back(px);
  points_.push_back(*place);
  show();
}

void Pointer::Stroke::show() const {
  Overlay overlay;
  overlay.lines.push_back({px_, Role::stroke});
  view_.set_tool_overlay(std::move(overlay));
}

void Pointer::Stroke::move(const PointerEvent& event) {
  add(event.px);
}

void Pointer::Stroke::cancel() {
  view_.set_tool_overlay({});
}

void Pointer::Stroke::release(const PointerEvent& event) {
  add(event.px);
  view_.set_tool_overlay({});
  session::Workbench& bench = view_.bench();
  if (points_.size() < 2) return;
  if (const auto* curved = dynamic_cast<const CurvedView*>(&view_)) {
    lumen::CprStroke stroke;
    stroke.vessel = bench.vessel.get();
    stroke.points = points_;
    stroke.mode = bench.curved_mode.get() == reformat::CurvedMode::straightened
                      ? lumen::ReformationMode::straightened
                      : lumen::ReformationMode::stretched;
    stroke.theta_deg = curved->theta_deg();
    stroke.beta_deg = bench.beta_deg.get();
    bench.edit(stroke);
  } else if (const auto* section = dynamic_cast<const SectionView*>(&view_)) {
    lumen::SectionContour contour;
    contour.vessel = bench.vessel.get();
    contour.s_mm = section->s_mm();
    contour.eps_mm = bench.section_eps_mm.get();
    contour.closed = px_.size() > 8 && (px_.front() - px_.back()).norm() < closing_units * view_.density();
    contour.points = points_;
    bench.edit(contour);
  }
}

Pointer::Brush::Brush(PictureView& view, const PointerEvent& event) : view_(view) {
  edit_.vessel = view.bench().vessel.get();
  edit_.radius_mm = view.bench().brush_mm.get();
  push(event);
}

void Pointer::Brush::push(const PointerEvent& event) {
  const std::optional<Vec3> place = view_.world(event.px);
  if (!place) return;
  Overlay overlay;
  OverlayLine ball;
  ball.role = Role::stroke;
  const double radius_px = edit_.radius_mm / view_.pixel_mm();
  for (int i = 0; i <= 48; ++i) {
    const double angle = 2.0 * M_PI * i / 48.0;
    ball.px.push_back(event.px + radius_px * Vec2(std::cos(angle), std::sin(angle)));
  }
  overlay.lines.push_back(std::move(ball));
  view_.set_tool_overlay(std::move(overlay));
  if (!edit_.path.empty() && (edit_.path.back() - *place).norm() < push_step * edit_.radius_mm) return;
  lumen::WallPush longer = edit_;
  longer.path.push_back(*place);
  session::Workbench& bench = view_.bench();
  steps_.note(bench, edit_.path.empty() ? bench.edit(longer) : bench.edit_merged(longer));
  edit_ = std::move(longer);
}

void Pointer::Brush::move(const PointerEvent& event) {
  push(event);
}
void Pointer::Brush::cancel() {
  view_.set_tool_overlay({});
}

Pointer::MoveAxis::MoveAxis(PictureView& view, const PointerEvent& event, std::int32_t vessel,
                            const Vec3& from)
    : view_(view), start_(event.px), live_(dynamic_cast<CurvedView*>(&view) == nullptr) {
  edit_.vessel = vessel;
  edit_.from = from;
  edit_.to = from;
  edit_.reach_mm = std::max(view.bench().reach_mm.get(), 2.0);
}

void Pointer::MoveAxis::move(const PointerEvent& event) {
  const std::optional<Vec3> to = view_.world(event.px);
  if (!to) return;
  if (!moved_ && (start_ - event.px).norm() < least_drag_units * view_.density()) return;
  edit_.to = *to;
  if (live_) {
    session::Workbench& bench = view_.bench();
    steps_.note(bench, moved_ ? bench.edit_merged(edit_) : bench.edit(edit_));
  } else {
    Overlay overlay;
    overlay.lines.push_back({{start_, event.px}, Role::stroke, 1.0, true});
    overlay.marks.push_back({event.px, Role::handle, 4.0});
    view_.set_tool_overlay(std::move(overlay));
  }
  moved_ = true;
}

void Pointer::MoveAxis::release(const PointerEvent&) {
  view_.set_tool_overlay({});
  if (moved_ && !live_) view_.bench().edit(edit_);
}

void Pointer::MoveAxis::cancel() {
  view_.set_tool_overlay({});
}

}  // namespace ostia::view
