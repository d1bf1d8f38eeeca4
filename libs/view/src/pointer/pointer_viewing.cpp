#include "pointer/pointer_gestures.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::view {
namespace {

constexpr double hu_per_unit = 2.0;       // of window and level per unit of the interface
constexpr double degrees_per_unit = 0.5;  // of the CPR
constexpr double follow_mm = 1.0;  // beyond the lumen: how far from it a click still takes the cursor along

}  // namespace

NearestAxis nearest_axis(const session::Workbench& bench, const Vec3& place) {
  NearestAxis best;
  best.foot.rho_mm = std::numeric_limits<double>::infinity();
  const lumen::LumenModel* model = bench.model();
  if (!model) return best;
  const auto offer = [&](std::int32_t id, const geometry::AxisCurve& axis) {
    const geometry::AxisFoot foot = axis.nearest_foot(place);
    if (foot.rho_mm < best.foot.rho_mm - 1e-9) best = {id, foot};
  };
  // The selected vessel first: of several that share a stretch it is the one that is meant.
  if (const auto axis = bench.axis()) offer(bench.vessel.get(), *axis);
  for (const auto& vessel : model->vessels) offer(vessel->vessel, *bench.axis(vessel->vessel));
  return best;
}

void Pointer::Pan::move(const PointerEvent& event) {
  view_.pan(event.px - last_);
  last_ = event.px;
}

void Pointer::Contrast::move(const PointerEvent& event) {
  const Vec2 by = (event.px - last_) / view_.density();
  last_ = event.px;
  session::GreyWindow window = view_.bench().grey.get();
  window.width_hu = std::clamp(window.width_hu + hu_per_unit * by.x(), 1.0, 5000.0);
  window.level_hu = std::clamp(window.level_hu + hu_per_unit * by.y(), -2000.0, 4000.0);
  view_.bench().grey.set(window);
}

Pointer::Turn::Turn(PictureView& view, const PointerEvent& event) : view_(view), last_(event.px) {
  view_.bench().turning.set(dynamic_cast<CurvedView*>(&view_) != nullptr);
}
Pointer::Turn::~Turn() {
  view_.bench().turning.set(false);
}

void Pointer::Turn::move(const PointerEvent& event) {
  const Vec2 by = (event.px - last_) / view_.density();
  last_ = event.px;
  if (auto* slice = dynamic_cast<SliceView*>(&view_)) {
    slice->tilt(degrees_per_unit * by.y(), degrees_per_unit * by.x());
    return;
  }
  session::Property<double>& theta = view_.bench().theta_deg;
  theta.set(std::remainder(theta.get() + degrees_per_unit * by.x(), 360.0));
}

Pointer::TurnPlanes::TurnPlanes(LinkedPlaneView& view, const PointerEvent& event)
    : view_(view), last_rad_(view.angle_at(event.px)) {}

void Pointer::TurnPlanes::move(const PointerEvent& event) {
  const double now = view_.angle_at(event.px);
  view_.planes().turn(view_.kind(), std::remainder(now - last_rad_, 2.0 * M_PI));
  last_rad_ = now;
}

std::optional<LinkedPlaneView::Hold> held_of_planes(PictureView& view, const PointerEvent& event) {
  const session::Workbench& bench = view.bench();
  const bool browsing = !bench.has_case() || bench.tool.get() == session::Tool::browse;
  auto* linked = dynamic_cast<LinkedPlaneView*>(&view);
  return linked && browsing && !event.shift ? linked->hold_at(event.px) : std::nullopt;
}

std::unique_ptr<Pointer::Gesture> Pointer::gesture_of_planes(const PointerEvent& event) {
  const auto hold = held_of_planes(view_, event);
  if (!hold) return nullptr;
  auto& linked = dynamic_cast<LinkedPlaneView&>(view_);
  if (hold->grip == LinkedPlaneView::Grip::slab) return std::make_unique<DragSlab>(linked, hold->plane);
  return std::make_unique<TurnPlanes>(linked, event);
}

Pointer::Browse::Browse(PictureView& view, const PointerEvent& event) : view_(view) {
  move(event);
}

void Pointer::Browse::move(const PointerEvent& event) {
  session::Workbench& bench = view_.bench();
  if (auto* curved = dynamic_cast<CurvedView*>(&view_)) {
    bench.cursor_mm.set(curved->abscissa_at(event.px.y()));
    return;
  }
  const std::optional<Vec3> place = view_.world(event.px);
  if (!place) return;
  if (dynamic_cast<SliceView*>(&view_) || dynamic_cast<LinkedPlaneView*>(&view_)) {
    // On or beside the selected vessel the cursor goes along; the crosshair stays where it was put.
    if (const auto axis = bench.axis()) {
      const geometry::AxisFoot foot = axis->nearest_foot(*place);
      if (!foot.past_end && foot.rho_mm < axis->radius(foot.s_mm) + follow_mm) bench.cursor_mm.set(foot.s_mm);
    }
  }
  bench.place.set(*place);
}

}  // namespace ostia::view
