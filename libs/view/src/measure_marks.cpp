#include "measure_marks.h"

#include "ostia/core/error.h"
#include "ostia/view/words.h"

#include <algorithm>
#include <cmath>

namespace ostia::view {

std::string measured_text(const session::Workbench& bench, const analysis::Measurement& measurement) {
  try {
    const std::vector<analysis::MeasuredValue> values = bench.measured(measurement);
    return values.empty() ? std::string() : analysis::to_text(values.front());
  } catch (const Error&) {
    return words().not_measurable;
  }
}

std::string caption(const analysis::Measurement& measurement) {
  return measurement.name.empty() ? std::to_string(measurement.id) : measurement.name;
}

std::vector<StretchMark> stretches_of(const session::Workbench& bench) {
  std::vector<StretchMark> marks;
  if (!bench.has_case() || !bench.marks_shown.get()) return marks;
  for (const analysis::Measurement& one : bench.session().file().annotations()->measurements)
    if (one.points.empty() && one.vessel == bench.vessel.get())
      marks.push_back({one.from_mm, std::max(one.from_mm, one.to_mm),
                       caption(one) + ": " + measured_text(bench, one),
                       one.id == bench.selected_measurement.get()});
  return marks;
}

void add_measurement_marks(Overlay& overlay, PictureView& view, const analysis::Measurement& measurement,
                           double reach_mm) {
  std::vector<Vec2> px;
  for (const Vec3& point : measurement.points) {
    const std::optional<ViewPlace> shown = view.project(point);
    if (!shown || std::abs(shown->out_mm) > reach_mm) return;
    px.push_back(shown->px);
  }
  const bool selected = view.bench().selected_measurement.get() == measurement.id;
  const Role role = selected ? Role::selected : Role::measurement;
  // Of an outline's many points as many as can be told apart.
  const double apart = px.size() > 3 ? 12.0 * view.density() : 0.0;
  std::optional<Vec2> last;
  for (const Vec2& p : px) {
    if (last && (p - *last).norm() < apart) continue;
    overlay.marks.push_back({p, role, 3.5, 1.0, false});
    last = p;
  }
  OverlayLine line;
  line.px = px;
  line.role = role;
  if (measurement.kind == analysis::MeasureKind::area && px.size() > 2) line.px.push_back(px.front());
  if (line.px.size() > 1) overlay.lines.push_back(std::move(line));
  overlay.texts.push_back({px.back() + Vec2(6.0, -6.0) * view.density(),
                           caption(measurement) + ": " + measured_text(view.bench(), measurement), role,
                           Anchor::bottom_left});
}

}  // namespace ostia::view
