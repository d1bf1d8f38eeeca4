#include "ostia/view/scene_pointer.h"

#include "pictures/section_places.h"
#include "pointer/measure_marks.h"
#include "pointer/measure_placing.h"

#include "ostia/view/scene_measurements.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <utility>

namespace ostia::view {
namespace {

using analysis::MeasureKind;
using analysis::Measurement;
using geometry::Vec2;

constexpr int area_points = 128;  // of a round lumen: 0.04 % of the area are lost between them

std::size_t clicks_of(MeasureKind kind) {
  switch (kind) {
    case MeasureKind::angle:
      return 3;
    case MeasureKind::distance:
    case MeasureKind::arrow:
    case MeasureKind::stenosis:
    case MeasureKind::volume:
      return 2;
    case MeasureKind::area:
    case MeasureKind::diameter:
    case MeasureKind::ring_hu:
    case MeasureKind::note:
      return 1;
  }
  return 1;
}

/// Is the place on the vessel's way? Its abscissa is then the same there.
bool on_way_of(const session::Workbench& bench, std::int32_t vessel, const ScenePick& place) {
  if (place.vessel == vessel) return true;
  const auto axis = bench.axis(vessel);
  return axis && place.s_mm <= axis->length() &&
         lumen::owner_at(bench.model()->tree, vessel, place.s_mm) == place.vessel;
}

/// The one vessel along which both places lie.
std::optional<std::int32_t> common_vessel(const session::Workbench& bench, const ScenePick& a,
                                          const ScenePick& b) {
  for (const std::int32_t vessel : {*a.vessel, *b.vessel})
    if (on_way_of(bench, vessel, a) && on_way_of(bench, vessel, b)) return vessel;
  return std::nullopt;
}

/// What places make; `why` tells where they make nothing.
std::optional<Measurement> measurement_of(MeasureKind kind, const std::vector<ScenePick>& places,
                                          const session::Workbench& bench, const Vec3& sight,
                                          std::string& why) {
  const ScenePick& last = places.back();
  switch (kind) {
    case MeasureKind::distance:
    case MeasureKind::arrow:
    case MeasureKind::note:
    case MeasureKind::angle: {
      std::vector<Vec3> points;
      for (const ScenePick& place : places) points.push_back(place.point);
      return of_points(kind, std::move(points));
    }
    case MeasureKind::stenosis:
    case MeasureKind::volume: {
      const std::optional<std::int32_t> vessel = common_vessel(bench, places.front(), last);
      if (vessel) return of_stretch(kind, *vessel, places.front().s_mm, last.s_mm);
      why = words().other_vessel;
      return std::nullopt;
    }
    case MeasureKind::ring_hu:
      return ring_at(*last.vessel, last.s_mm);
    case MeasureKind::area:
    case MeasureKind::diameter:
      break;
  }
  why = words().no_lumen;
  auto section = section_of(bench, *last.vessel, last.s_mm, area_points);
  if (!section) return std::nullopt;
  if (kind == MeasureKind::area) return of_points(kind, std::move(section->contour));
  const auto ends = diameter_ends(*section, sight);
  if (!ends) return std::nullopt;
  return of_points(kind, {ends->first, ends->second}, *last.vessel);
}

/// The measurement with one of its handles on a place of the wall; nothing where it does not fit there.
std::optional<Measurement> with_handle(const session::Workbench& bench, Measurement measurement,
                                       std::size_t handle, const ScenePick& to) {
  if (!measurement.points.empty()) {
    if (handle >= measurement.points.size()) return std::nullopt;
    measurement.points[handle] = to.point;
    return measurement;
  }
  if (!on_way_of(bench, measurement.vessel, to)) return std::nullopt;
  const std::optional<EndRoom> room = room_of_end(bench, measurement, handle);
  if (!room || to.s_mm < room->from_mm || to.s_mm > room->to_mm) return std::nullopt;
  return with_end(std::move(measurement), handle, to.s_mm);
}

/// What is placed so far of a measurement that needs more.
std::optional<SceneMeasurement> begun(const session::Workbench& bench, MeasureKind kind,
                                      const std::vector<ScenePick>& places) {
  SceneMeasurement shown;
  for (const ScenePick& place : places) shown.points.push_back(place.point);
  if (kind == MeasureKind::stenosis || kind == MeasureKind::volume)
    if (auto section = section_of(bench, *places.front().vessel, places.front().s_mm))
      shown.curves.push_back({std::move(section->contour), true});
  return shown;
}

}  // namespace

struct ScenePointer::Held {
  HeldMeasurement measurement;
  std::size_t handle = 0;
};

ScenePointer::ScenePointer(TreeScene& scene, session::Workbench& bench) : scene_(scene), bench_(bench) {
  own_.push_back(bench.tool.observe([this](const session::Tool&) { drop(); }));
  own_.push_back(bench.case_changed.observe([this] { drop(); }));
  own_.push_back(bench.model_changed.observe([this](const session::ModelEvent& event) {
    if (event.tree_changed) drop();  // places may be on vessels that are gone
  }));
}
ScenePointer::~ScenePointer() = default;

bool ScenePointer::busy() const {
  return held_ != nullptr || !clicked_.empty();
}

std::optional<std::size_t> ScenePointer::handle_near(const Vec2& px) const {
  if (!bench_.has_case() || !bench_.marks_shown.get() || !clicked_.empty()) return std::nullopt;
  const auto annotations = bench_.session().file().annotations();
  const Measurement* selected = session::find_measurement(*annotations, bench_.selected_measurement.get());
  if (!selected) return std::nullopt;
  double nearest = handle_reach_units * scene_.pixel_ratio();
  std::optional<std::size_t> found;
  const std::vector<Vec3> handles = handles_of(bench_, *selected);
  for (std::size_t i = 0; i < handles.size(); ++i) {
    const double away = (scene_.project(handles[i]) - px).norm();
    if (away > nearest) continue;
    nearest = away;
    found = i;
  }
  return found;
}

bool ScenePointer::press(const PointerEvent& event) {
  if (button_ != Button::none) return held_ != nullptr;
  button_ = event.button;
  pressed_ = event.px;
  moved_ = false;
  if (event.button != Button::left || event.shift) return false;
  const std::optional<std::size_t> handle = handle_near(event.px);
  if (!handle) return false;
  show_draft(std::optional<SceneMeasurement>());
  held_ = std::make_shared<Held>(Held{{bench_, bench_.selected_measurement.get()}, *handle});
  shape_ = CursorShape::grab;
  return true;
}

void ScenePointer::move(const PointerEvent& event) {
  if (button_ == Button::none) {
    hover(event.px);
    return;
  }
  if (!moved_ && (event.px - pressed_).norm() < trembling_units * scene_.pixel_ratio()) return;
  moved_ = true;
  if (held_) drag(event.px);
}

void ScenePointer::drag(const Vec2& px) {
  const std::optional<ScenePick> to = scene_.pick(px);
  if (!to || !to->vessel) return;
  const std::shared_ptr<Held> held = held_;
  if (auto next = with_handle(bench_, held->measurement.now(), held->handle, *to)) {
    held->measurement.become(std::move(*next));
    stale.tell();
  }
}

void ScenePointer::release(const PointerEvent& event) {
  if (event.button != button_) return;  // of another button meanwhile
  button_ = Button::none;
  const bool was_held = std::exchange(held_, nullptr) != nullptr;
  if (event.button == Button::left && !was_held && !moved_)
    click(event.px);
  else
    hover(event.px);
}

void ScenePointer::click(const Vec2& px) {
  if (!bench_.has_case()) return;
  const std::optional<ScenePick> hit = scene_.pick(px);
  const std::optional<MeasureKind> kind = session::measure_kind(bench_.tool.get());
  if (!kind)
    choose(hit);
  else if (hit && hit->vessel)
    place(*kind, *hit);
  else
    bench_.noted.tell(words().off_wall);
}

void ScenePointer::choose(const std::optional<ScenePick>& hit) {
  if (!hit) return;
  if (hit->measurement) bench_.selected_measurement.set(*hit->measurement);
  if (!hit->vessel) return;
  bench_.vessel.set(*hit->vessel);
  bench_.cursor_mm.set(hit->s_mm);
}

void ScenePointer::place(MeasureKind kind, const ScenePick& hit) {
  bench_.require_own_phase();
  if (!clicked_.empty() && (scene_.project(clicked_.back().point) - scene_.project(hit.point)).norm() <
                               trembling_units * scene_.pixel_ratio())
    return;  // the second half of a double click
  std::vector<ScenePick> places = clicked_;
  places.push_back(hit);
  std::string why;
  if (places.size() < clicks_of(kind)) {
    clicked_ = std::move(places);
    show_draft(std::optional<ScenePick>());
  } else if (auto made = measurement_of(kind, places, bench_, scene_.pose().towards, why)) {
    add_measurement(bench_, std::move(*made));
    drop();
  } else {
    bench_.noted.tell(why);
  }
}

void ScenePointer::hover(const Vec2& px) {
  const std::optional<MeasureKind> kind = session::measure_kind(bench_.tool.get());
  shape_ = CursorShape::arrow;
  if (!bench_.has_case()) return;
  if (handle_near(px)) {
    shape_ = CursorShape::grab;
    show_draft(std::optional<ScenePick>());
    return;
  }
  if (!kind || bench_.other_phase()) return;
  std::optional<ScenePick> hit = scene_.pick(px);
  if (hit && !hit->vessel) hit.reset();
  if (hit) shape_ = CursorShape::cross;
  // A measurement that is placed by one click shows itself before, but not over one that is there.
  if (clicked_.empty() && (clicks_of(*kind) > 1 || (hit && hit->measurement))) hit.reset();
  show_draft(hit);
}

void ScenePointer::show_draft(const std::optional<ScenePick>& hovered) {
  const std::optional<MeasureKind> kind = session::measure_kind(bench_.tool.get());
  std::vector<ScenePick> places = clicked_;
  if (hovered) places.push_back(*hovered);
  if (!kind || places.empty()) {
    show_draft(std::optional<SceneMeasurement>());
    return;
  }
  std::string why;
  if (places.size() == clicks_of(*kind))
    if (const auto made = measurement_of(*kind, places, bench_, scene_.pose().towards, why)) {
      std::optional<SceneMeasurement> shown = in_scene(bench_, *made);
      if (shown && *kind != MeasureKind::ring_hu) shown->label = measured_text(bench_, *made);
      if (shown) shown->dots = *kind != MeasureKind::area;
      show_draft(std::move(shown));
      return;
    }
  const bool fits = places.size() < clicks_of(*kind);
  show_draft(clicked_.empty() && !fits ? std::nullopt : begun(bench_, *kind, fits ? places : clicked_));
}

void ScenePointer::show_draft(std::optional<SceneMeasurement> draft) {
  if (!draft && !draft_shown_) return;
  draft_shown_ = draft.has_value();
  scene_.set_draft(std::move(draft));
  stale.tell();
}

void ScenePointer::leave() {
  if (button_ == Button::none) show_draft(std::optional<ScenePick>());
}

void ScenePointer::cancel() {
  const std::shared_ptr<Held> begun = held_;
  drop();
  if (begun) begun->measurement.take_back();
}

void ScenePointer::let_go() {
  button_ = Button::none;
  held_.reset();
}

void ScenePointer::drop() {
  clicked_.clear();
  if (std::exchange(held_, nullptr)) moved_ = true;  // its release is no click
  show_draft(std::optional<SceneMeasurement>());
}

bool ScenePointer::erase(const PointerEvent& event) {
  if (!bench_.has_case() || !bench_.marks_shown.get()) return false;
  const std::optional<ScenePick> hit = scene_.pick(event.px);
  const std::int32_t id = hit && hit->measurement ? *hit->measurement : bench_.selected_measurement.get();
  if (!session::find_measurement(*bench_.session().file().annotations(), id)) return false;
  held_.reset();
  bench_.annotate(session::MeasureDelete{id});
  return true;
}

}  // namespace ostia::view
