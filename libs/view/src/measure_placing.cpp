#include "measure_placing.h"

#include <algorithm>
#include <atomic>
#include <tuple>
#include <utility>

namespace ostia::view {
namespace {

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

HeldMeasurement::HeldMeasurement(session::Workbench& bench, std::int32_t id)
    : bench_(bench), drag_(new_drag()) {
  if (const auto* found = session::find_measurement(*bench.session().file().annotations(), id)) now_ = *found;
  bench.selected_measurement.set(id);
}

void HeldMeasurement::become(analysis::Measurement next) {
  bench_.annotate_merged(session::MeasureChange{next}, drag_);
  now_ = std::move(next);
}

}  // namespace ostia::view
