#include "ostia/view/scene_measurements.h"

#include "pictures/section_places.h"
#include "pointer/measure_marks.h"
#include "pointer/measure_placing.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

using analysis::MeasureKind;
using analysis::Measurement;

constexpr double axis_step_mm = 0.5;

std::vector<Vec3> axis_between(const geometry::AxisCurve& axis, double from_mm, double to_mm) {
  const int pieces = std::max(1, static_cast<int>(std::ceil((to_mm - from_mm) / axis_step_mm)));
  std::vector<Vec3> points;
  for (int i = 0; i <= pieces; ++i) points.push_back(axis.point(from_mm + (to_mm - from_mm) * i / pieces));
  return points;
}

/// Abscissa of the narrowest place; nothing where the stenosis cannot be measured.
std::optional<double> throat_of(const session::Workbench& bench, const Measurement& stenosis) {
  const analysis::LumenProfile* profile = bench.profile(stenosis.vessel);
  if (!profile) return std::nullopt;
  try {
    return analysis::stenosis_between(*profile, stenosis.from_mm, stenosis.to_mm).throat_mm;
  } catch (const InvalidInput&) {
    return std::nullopt;
  }
}

void add_outline(SceneMeasurement& shown, const session::Workbench& bench, std::int32_t vessel, double s_mm) {
  if (auto section = section_of(bench, vessel, s_mm))
    shown.curves.push_back({std::move(section->contour), true});
}

void add_stretch(SceneMeasurement& shown, const session::Workbench& bench, const Measurement& of) {
  const auto axis = bench.axis(of.vessel);
  const double to = std::min(of.to_mm, axis->length()), from = std::min(of.from_mm, to);
  shown.curves.push_back({axis_between(*axis, from, to), false});
  add_outline(shown, bench, of.vessel, from);
  add_outline(shown, bench, of.vessel, to);
  shown.label_at = shown.points.back();
  if (of.kind != MeasureKind::stenosis) return;
  if (const std::optional<double> throat = throat_of(bench, of)) {
    add_outline(shown, bench, of.vessel, *throat);
    shown.label_at = axis->point(*throat);
  }
}

void add_ring(SceneMeasurement& shown, const session::Workbench& bench, const Measurement& of) {
  const auto section = section_of(bench, of.vessel, of.from_mm);
  if (!section) return;
  shown.curves.push_back({widened(*section, of.inner_mm), true});
  shown.curves.push_back({widened(*section, of.outer_mm), true});
}

}  // namespace

std::vector<Vec3> handles_of(const session::Workbench& bench, const Measurement& measurement) {
  if (!measurement.points.empty()) return measurement.points;
  const auto axis = bench.axis(measurement.vessel);
  if (!axis) return {};
  std::vector<Vec3> handles;
  for (const double s : ends_of(measurement)) handles.push_back(axis->point(s));
  return handles;
}

std::optional<SceneMeasurement> in_scene(const session::Workbench& bench, const Measurement& measurement) {
  SceneMeasurement shown;
  shown.id = measurement.id;
  shown.points = handles_of(bench, measurement);
  if (shown.points.empty()) return std::nullopt;
  shown.selected = measurement.id != 0 && measurement.id == bench.selected_measurement.get();
  if (measurement.kind == MeasureKind::area) {
    shown.closed = true;
    shown.dots = shown.selected;  // they would hide a small outline
  } else if (measurement.kind == MeasureKind::ring_hu) {
    add_ring(shown, bench, measurement);
  } else if (measurement.points.empty()) {
    add_stretch(shown, bench, measurement);
  }
  return shown;
}

std::vector<SceneMeasurement> scene_measurements(const session::Workbench& bench) {
  std::vector<SceneMeasurement> all;
  if (!bench.has_case() || !bench.marks_shown.get() || bench.other_phase()) return all;
  for (const Measurement& one : bench.session().file().annotations()->measurements)
    if (std::optional<SceneMeasurement> shown = in_scene(bench, one)) {
      shown->label = label_of(bench, one);
      all.push_back(std::move(*shown));
    }
  return all;
}

}  // namespace ostia::view
