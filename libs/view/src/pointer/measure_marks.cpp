#include "pointer/measure_marks.h"

#include "pointer/measure_placing.h"

#include "ostia/core/error.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {

std::string measured_text(const session::Workbench& bench, const analysis::Measurement& measurement) {
  try {
    const std::vector<analysis::MeasuredValue> values = bench.measured(measurement);
    if (values.empty()) return {};
    std::string text = analysis::to_text(values.front());
    const auto value_of = [&](const char* name) {
      return std::find_if(values.begin(), values.end(),
                          [name](const analysis::MeasuredValue& one) { return one.name == name; });
    };
    const auto mean = value_of("mean"), deviation = value_of("SD");
    if (mean == values.end() || deviation == values.end()) return text;
    // "345 \u00b1 21 HU", behind an area's size.
    analysis::MeasuredValue number = *mean;
    number.unit.clear();
    const std::string hu = analysis::to_text(number) + " \u00b1 " + analysis::to_text(*deviation);
    return mean == values.begin() ? hu : text + ", " + hu;
  } catch (const Error&) {
    return words().not_measurable;
  }
}

std::string label_of(const session::Workbench& bench, const analysis::Measurement& measurement) {
  const std::string name = measurement.name.empty()
                               ? words().kind(measurement.kind) + " " + std::to_string(measurement.id)
                               : measurement.name;
  return analysis::is_remark(measurement.kind) ? name : name + ": " + measured_text(bench, measurement);
}

Role role_of(const session::Workbench& bench, const analysis::Measurement& measurement) {
  return bench.selected_measurement.get() == measurement.id ? Role::selected : Role::measurement;
}

std::vector<analysis::Measurement> stretches_of(const session::Workbench& bench) {
  std::vector<analysis::Measurement> found;
  if (!bench.has_case() || !bench.marks_shown.get() || bench.other_phase()) return found;
  for (const analysis::Measurement& one : bench.session().file().annotations()->measurements)
    if (one.points.empty() && one.vessel == bench.vessel.get()) found.push_back(one);
  return found;
}

std::optional<HandleHit> end_near(const session::Workbench& bench, const Vec2& px, double reach_px,
                                  const EndLine& line_of) {
  std::optional<HandleHit> best;
  double nearest = reach_px;
  for (const analysis::Measurement& one : stretches_of(bench)) {
    const std::vector<double> ends = ends_of(one);
    for (std::size_t i = 0; i < ends.size(); ++i) {
      const auto [a, b] = line_of(ends[i]);
      const double distance = foot_on_segment(px, a, b).distance;
      if (distance > nearest) continue;
      nearest = distance;
      best = HandleHit{one.id, i, true, distance};
    }
  }
  return best;
}

SegmentFoot foot_on_segment(const Vec2& p, const Vec2& a, const Vec2& b) {
  const Vec2 along = b - a;
  const double length2 = along.squaredNorm();
  SegmentFoot foot;
  foot.t = length2 > 0.0 ? std::clamp((p - a).dot(along) / length2, 0.0, 1.0) : 0.0;
  foot.place = a + foot.t * along;
  foot.distance = (p - foot.place).norm();
  return foot;
}

/// Two short lines at an arrow's tip.
void add_head(Overlay& overlay, const Vec2& tip, const Vec2& tail, double long_px, Role role,
              std::int32_t id) {
  const Vec2 back = tail - tip;
  if (!(back.norm() > 1.0)) return;
  const Vec2 along = back.normalized(), across(-along.y(), along.x());
  OverlayLine head;
  head.px = {tip + long_px * (along + 0.4 * across), tip, tip + long_px * (along - 0.4 * across)};
  head.role = role;
  head.of = id;
  overlay.lines.push_back(std::move(head));
}

void add_measurement_marks(Overlay& overlay, PictureView& view, const analysis::Measurement& measurement,
                           double reach_mm) {
  std::vector<Vec2> px;
  for (const Vec3& point : measurement.points) {
    const std::optional<ViewPlace> shown = view.project(point);
    if (!shown || std::abs(shown->out_mm) > reach_mm) return;
    px.push_back(shown->px);
  }
  const Role role = role_of(view.bench(), measurement);
  // Of an outline's many points as many as can be told apart.
  const double apart = px.size() > 3 ? 12.0 * view.density() : 0.0;
  std::optional<Vec2> last;
  // The tip of an arrow is to be seen itself, unless it can be taken hold of.
  const bool arrow = measurement.kind == analysis::MeasureKind::arrow;
  if (arrow) add_head(overlay, px.front(), px.back(), 10.0 * view.density(), role, measurement.id);
  for (const Vec2& p : px) {
    if (arrow && role != Role::selected) break;
    if (last && (p - *last).norm() < apart) continue;
    overlay.marks.push_back({p, role, 3.5, 1.0, false});
    last = p;
  }
  OverlayLine line;
  line.px = px;
  line.role = role;
  line.of = measurement.id;
  if (measurement.kind == analysis::MeasureKind::area && px.size() > 2) line.px.push_back(px.front());
  if (line.px.size() > 1) overlay.lines.push_back(std::move(line));
  // Beside the last point that is to be seen.
  const auto seen = std::find_if(px.rbegin(), px.rend(), [&](const Vec2& p) {
    return p.x() >= 0.0 && p.y() >= 0.0 && p.x() <= view.width() && p.y() <= view.height();
  });
  overlay.texts.push_back({seen != px.rend() ? *seen : px.back(), label_of(view.bench(), measurement), role,
                           Anchor::bottom_left, measurement.id});
}

}  // namespace ostia::view
