#include "pointer/measure_placing.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

namespace ostia::view {
namespace {

constexpr double least_stretch_mm = 0.5;

/// A fresh number for each drag.
std::int64_t new_drag() {
  static std::atomic<std::int64_t> last{0};
  return ++last;
}

}  // namespace

analysis::Measurement of_points(analysis::MeasureKind kind, std::vector<Vec3> points, std::int32_t vessel) {
  analysis::Measurement made;
  made.kind = kind;
  made.points = std::move(points);
  made.vessel = vessel;
  return made;
}

analysis::Measurement of_stretch(analysis::MeasureKind kind, std::int32_t vessel, double a_mm, double b_mm) {
  analysis::Measurement made;
  made.kind = kind;
  made.vessel = vessel;
  std::tie(made.from_mm, made.to_mm) = std::minmax(a_mm, b_mm);
  return made;
}

analysis::Measurement ring_at(std::int32_t vessel, double s_mm) {
  analysis::Measurement made;
  made.kind = analysis::MeasureKind::ring_hu;
  made.vessel = vessel;
  made.from_mm = made.to_mm = s_mm;
  return made;
}

void add_measurement(session::Workbench& bench, analysis::Measurement made) {
  const session::Session::Done done = bench.annotate(session::MeasureAdd{std::move(made)});
  if (!done.annotations.measurements.empty())
    bench.selected_measurement.set(done.annotations.measurements.front());
}

std::vector<double> ends_of(const analysis::Measurement& measurement) {
  if (!measurement.points.empty()) return {};
  if (measurement.kind == analysis::MeasureKind::ring_hu) return {measurement.from_mm};
  return {measurement.from_mm, measurement.to_mm};
}

std::optional<EndRoom> room_of_end(const session::Workbench& bench, const analysis::Measurement& measurement,
                                   std::size_t end) {
  const auto axis = bench.axis(measurement.vessel);
  if (!axis) return std::nullopt;
  EndRoom room{0.0, axis->length()};
  if (measurement.kind != analysis::MeasureKind::ring_hu) {
    // One that was made shorter may stay so.
    const double apart = std::min(least_stretch_mm, measurement.to_mm - measurement.from_mm);
    if (end == 0)
      room.to_mm = std::min(room.to_mm, measurement.to_mm - apart);
    else
      room.from_mm = measurement.from_mm + apart;
  }
  if (!(room.from_mm <= room.to_mm)) return std::nullopt;
  return room;
}

analysis::Measurement with_end(analysis::Measurement measurement, std::size_t end, double s_mm) {
  if (measurement.kind == analysis::MeasureKind::ring_hu)
    measurement.from_mm = measurement.to_mm = s_mm;
  else
    (end == 0 ? measurement.from_mm : measurement.to_mm) = s_mm;
  return measurement;
}

HeldMeasurement::HeldMeasurement(session::Workbench& bench, std::int32_t id)
    : bench_(bench), drag_(new_drag()) {
  if (const auto* found = session::find_measurement(*bench.session().file().annotations(), id)) now_ = *found;
  bench.selected_measurement.set(id);
}

void HeldMeasurement::become(analysis::Measurement next) {
  steps_.note(bench_, bench_.annotate_merged(session::MeasureChange{next}, drag_));
  now_ = std::move(next);
}

double HeldEnd::s_mm() const {
  const std::vector<double> ends = ends_of(now());
  return end_ < ends.size() ? ends[end_] : 0.0;
}

void HeldEnd::pull_to(double s_mm) {
  if (now().vessel != bench_.vessel.get()) return;  // another was chosen meanwhile
  if (const std::optional<EndRoom> room = room_of_end(bench_, now(), end_))
    held_.become(with_end(now(), end_, std::clamp(s_mm, room->from_mm, room->to_mm)));
}

}  // namespace ostia::view
