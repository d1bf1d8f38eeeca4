#include "ostia/view/pointer.h"

#include "pointer/measure_marks.h"
#include "pointer/pointer_gestures.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace ostia::view {
namespace {

using session::Tool;

constexpr double wall_reach_units = 10.0;  // from the contour line within which it is taken hold of
constexpr double axis_reach_units = 12.0;
constexpr double zoom_step = 1.2;

bool of_vessel(const PictureView& view) {
  return dynamic_cast<const CurvedView*>(&view) || dynamic_cast<const SectionView*>(&view);
}

/// A click is a vessel's end.
bool places_ends(Tool tool) {
  return tool == Tool::add_vessel || tool == Tool::add_artery;
}

bool edits_wall(Tool tool) {
  return tool == Tool::drag || tool == Tool::draw || tool == Tool::brush;
}

}  // namespace

Pointer::Pointer(PictureView& view) : view_(view) {
  session::Workbench& bench = view.bench();
  own_.push_back(bench.tool.observe([this](const Tool&) { drop(); }));
  own_.push_back(bench.case_changed.observe([this] { drop(); }));
  own_.push_back(bench.image_changed.observe([this] { drop(); }));
  // A picture along a vessel, or across it, is another one now; a slice stays.
  own_.push_back(bench.vessel.observe([this](const std::int32_t&) {
    if (of_vessel(view_)) drop();
  }));
}
Pointer::~Pointer() = default;

/// Tells of the outermost call.
class Pointer::Telling {
 public:
  Telling(Pointer& pointer, const HandAct& act) : pointer_(pointer) {
    if (pointer_.telling_++ == 0) pointer_.acting.tell(act);
  }
  ~Telling() {
    if (--pointer_.telling_ == 0) pointer_.acted.tell();
  }
  Telling(const Telling&) = delete;
  Telling& operator=(const Telling&) = delete;

 private:
  Pointer& pointer_;
};

bool Pointer::busy() const {
  return gesture_ != nullptr || !clicked_.empty();
}

std::unique_ptr<Pointer::Gesture> Pointer::gesture_of(const PointerEvent& event) {
  if (event.button == Button::middle || (event.button == Button::left && event.control && event.shift))
    return std::make_unique<Pan>(view_, event);
  if (event.button == Button::right) return std::make_unique<Contrast>(view_, event);
  if (event.button != Button::left) return nullptr;
  const auto* slice = dynamic_cast<SliceView*>(&view_);
  if (event.shift && (of_vessel(view_) || (slice && slice->kind() == SliceKind::oblique)))
    return std::make_unique<Turn>(view_, event);
  if (std::unique_ptr<Gesture> of_planes = gesture_of_planes(event)) return of_planes;
  if (const auto hit = handle_at(event)) {
    auto* curved = dynamic_cast<CurvedView*>(&view_);
    if (hit->along_vessel && curved) return std::make_unique<MoveEnd>(*curved, event, *hit);
    return std::make_unique<MoveHandle>(view_, event, *hit);
  }
  return gesture_of_tool(event);
}

/// Between clicks that belong together, and where a click is a vessel's end, no handle is taken hold of.
std::optional<HandleHit> Pointer::handle_at(const PointerEvent& event) {
  if (!clicked_.empty() || places_ends(view_.bench().tool.get())) return std::nullopt;
  return view_.handle_near(event.px, handle_reach_units * view_.density());
}

std::unique_ptr<Pointer::Gesture> Pointer::gesture_of_tool(const PointerEvent& event) {
  session::Workbench& bench = view_.bench();
  const Tool tool = bench.tool.get();
  auto* curved = dynamic_cast<CurvedView*>(&view_);
  if (!bench.has_case()) return std::make_unique<Browse>(view_, event);
  switch (tool) {
    case Tool::browse:
      return std::make_unique<Browse>(view_, event);
    case Tool::drag:
      taken_ = event.taken;
      if (!event.again)
        if (const auto hit = view_.wall_near(event.px, wall_reach_units * view_.density()))
          taken_ = hit->place;
      if (taken_) return std::make_unique<Drag>(view_, *taken_);
      return std::make_unique<Browse>(view_, event);
    case Tool::draw:
      if (of_vessel(view_)) return std::make_unique<Stroke>(view_, event);
      return std::make_unique<Browse>(view_, event);
    case Tool::brush:
      return std::make_unique<Brush>(view_, event);
    case Tool::axis: {
      const std::optional<Vec3> place = view_.world(event.px);
      if (!place) return nullptr;
      const NearestAxis nearest = nearest_axis(bench, *place);
      const auto axis = bench.axis(nearest.vessel);
      if (!axis) return nullptr;
      const Vec3 from = axis->point(nearest.foot.s_mm);
      const auto shown = view_.project(from);
      if (shown && (shown->px - event.px).norm() < axis_reach_units * view_.density())
        return std::make_unique<MoveAxis>(view_, event, nearest.vessel, from);
      return std::make_unique<Browse>(view_, event);
    }
    case Tool::distance:
    case Tool::diameter:
    case Tool::arrow:
      return std::make_unique<TwoPoints>(view_, event, *session::measure_kind(tool));
    case Tool::area:
      return std::make_unique<Outline>(view_, event);
    case Tool::stenosis:
    case Tool::volume:
      if (curved) return std::make_unique<Stretch>(*curved, event, *session::measure_kind(tool));
      return std::make_unique<Browse>(view_, event);
    case Tool::angle:
    case Tool::ring_hu:
    case Tool::note:
    case Tool::add_vessel:
    case Tool::add_artery:
      return nullptr;
  }
  return nullptr;
}

bool Pointer::click_of_tool(const PointerEvent& event) {
  session::Workbench& bench = view_.bench();
  const std::optional<Vec3> place = view_.world(event.px);
  if (!place) return false;
  if (places_ends(bench.tool.get())) {
    end_chosen.tell(*place);
    return true;
  }
  return bench.has_case() && measuring_click(event, *place);
}

void Pointer::press(const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::press, event, 0.0});
  if (gesture_ || !view_.ready()) return;
  taken_.reset();
  // At another phase of the heart the view can be turned, moved and walked through.
  if (event.button == Button::left && !event.shift && view_.bench().tool.get() != Tool::browse)
    view_.bench().require_own_phase();
  if (event.button == Button::left && !event.shift && !handle_at(event) && click_of_tool(event)) return;
  last_ = event;
  gesture_ = gesture_of(event);
  if (gesture_) shape_ = gesture_->shape();
}

void Pointer::move(const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::move, event, 0.0});
  if (const std::shared_ptr<Gesture> held = gesture_) {
    last_.px = event.px;
    held->move(event);
  } else if (view_.ready()) {
    hover(event);
  }
}

void Pointer::release(const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::release, event, 0.0});
  if (!gesture_) return;
  const std::shared_ptr<Gesture> ended = std::exchange(gesture_, nullptr);
  try {
    if (event.px != last_.px) ended->move(event);
    ended->release(event);
  } catch (...) {
    ended->cancel();
    throw;
  }
  ended->cancel();
  hover(event);
}

void Pointer::let_go() {
  if (gesture_) release(PointerEvent(last_));
}

void Pointer::hover(const PointerEvent& event) {
  const Tool tool = view_.bench().tool.get();
  shape_ = tool == Tool::browse ? CursorShape::arrow : CursorShape::cross;
  if (event.shift) {
    shape_ = CursorShape::turn;
    return;
  }
  if (const auto hold = held_of_planes(view_, event)) {
    shape_ = hold->grip == LinkedPlaneView::Grip::turn ? CursorShape::turn : CursorShape::move;
    return;
  }
  if (view_.bench().other_phase()) return;
  if (handle_at(event)) {
    shape_ = CursorShape::grab;
  } else if (tool == Tool::drag && view_.bench().has_case()) {
    Overlay overlay;
    if (const auto hit = view_.wall_near(event.px, wall_reach_units * view_.density())) {
      shape_ = CursorShape::grab;
      overlay.marks.push_back({hit->px, Role::handle, 4.5});
    }
    view_.set_tool_overlay(std::move(overlay));
  } else if (tool == Tool::brush) {
    Overlay overlay;
    OverlayLine ball;
    ball.role = Role::stroke;
    const double radius = view_.bench().brush_mm.get() / view_.pixel_mm();
    for (int i = 0; i <= 48; ++i) {
      const double angle = 2.0 * M_PI * i / 48.0;
      ball.px.push_back(event.px + radius * Vec2(std::cos(angle), std::sin(angle)));
    }
    overlay.lines.push_back(std::move(ball));
    view_.set_tool_overlay(std::move(overlay));
  }
}

void Pointer::double_click(const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::double_click, event, 0.0});
  session::Workbench& bench = view_.bench();
  if (bench.tool.get() != Tool::axis || !bench.has_case() || bench.other_phase()) return;
  const std::optional<Vec3> place = view_.world(event.px);
  if (!place) return;
  const NearestAxis nearest = nearest_axis(bench, *place);
  if (nearest.vessel == session::Workbench::no_vessel) return;
  drop();
  bench.edit(lumen::AxisInsert{nearest.vessel, *place});
}

bool Pointer::erase(const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::erase, event, 0.0});
  session::Workbench& bench = view_.bench();
  if (!bench.has_case() || !view_.ready()) return false;
  if (const auto hit = view_.handle_near(event.px, handle_reach_units * view_.density())) {
    bench.annotate(session::MeasureDelete{hit->measurement});
    return true;
  }
  if (bench.tool.get() != Tool::axis) return false;
  const std::optional<Vec3> place = view_.world(event.px);
  if (!place) return false;
  const NearestAxis nearest = nearest_axis(bench, *place);
  const auto axis = bench.axis(nearest.vessel);
  if (!axis) return false;
  const auto shown = view_.project(axis->point(nearest.foot.s_mm));
  if (!shown || (shown->px - event.px).norm() > axis_reach_units * view_.density()) return false;
  bench.edit(lumen::AxisDelete{nearest.vessel, axis->point(nearest.foot.s_mm)});
  return true;
}

void Pointer::wheel(double steps, const PointerEvent& event) {
  const Telling telling(*this, {HandAct::Kind::wheel, event, steps});
  if (!view_.ready()) return;
  if (event.control) {
    view_.zoom(std::pow(zoom_step, steps), event.px);
  } else if (event.shift && edits_wall(view_.bench().tool.get())) {
    session::Workbench& bench = view_.bench();
    if (bench.tool.get() == Tool::brush)
      bench.brush_mm.set(bench.brush_mm.get() + 0.1 * steps);
    else
      bench.reach_mm.set(bench.reach_mm.get() + 0.5 * steps);
    hover(event);
  } else if (auto* linked = dynamic_cast<LinkedPlaneView*>(&view_); linked && event.shift) {
    linked->thicken(steps);
  } else {
    view_.scroll(steps);
  }
}

void Pointer::leave() {
  const Telling telling(*this, {HandAct::Kind::leave, {}, 0.0});
  if (!busy()) view_.set_tool_overlay({});
}

void Pointer::cancel() {
  const Telling telling(*this, {HandAct::Kind::cancel, {}, 0.0});
  const std::shared_ptr<Gesture> begun = gesture_;
  drop();
  if (begun) begun->take_back();
}

void Pointer::drop() {
  if (gesture_) gesture_->cancel();
  gesture_.reset();
  clicked_.clear();
  view_.set_tool_overlay({});
}

}  // namespace ostia::view
