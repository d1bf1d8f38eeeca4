#include "walls/lumen_on_rays.h"

#include "ostia/core/error.h"
#include "ostia/pipeline/image_walls.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>
#include <string>
#include <vector>

namespace ostia::session {
namespace {

using geometry::Vec2;
using geometry::Vec3;

constexpr double shut_mm = 0.05;      // of a lumen that is not there
constexpr double usual_end_mm = 1.0;  // left out at an end whose radius is not known
constexpr double same_place_mm = 1e-9;

/// How far a closed line lies from the axis along each ray; its outermost crossing. Negative where none.
std::vector<double> radii_of(const std::vector<Vec3>& contour, const geometry::AxisCurve& axis, double s_mm,
                             int around) {
  constexpr double pi = std::numbers::pi;
  const geometry::Frame frame = axis.frame(s_mm);
  const Vec3 centre = axis.point(s_mm), x = geometry::radial_direction(frame, 0.0),
             y = geometry::radial_direction(frame, 0.5 * pi);
  std::vector<Vec2> line;
  for (const Vec3& p : contour) line.emplace_back((p - centre).dot(x), (p - centre).dot(y));
  std::vector<double> out(static_cast<std::size_t>(around), -1.0);
  for (int a = 0; a < around; ++a) {
    const Vec2 ray(std::cos(2.0 * pi * a / around), std::sin(2.0 * pi * a / around));
    const auto side = [&](const Vec2& p) { return ray.x() * p.y() - ray.y() * p.x(); };
    for (std::size_t i = 0; i < line.size(); ++i) {
      const Vec2 &p = line[i], &q = line[(i + 1) % line.size()];
      if ((side(p) <= 0.0) == (side(q) <= 0.0)) continue;
      const double t = side(p) / (side(p) - side(q));
      out[a] = std::max(out[a], ray.dot(p + t * (q - p)));
    }
  }
  return out;
}

std::size_t index_of(const lumen::LumenModel& model, std::int32_t vessel) {
  for (std::size_t i = 0; i < model.tree.vessels.size(); ++i)
    if (model.tree.vessels[i].id == vessel) return i;
  throw InvalidInput("there is no vessel " + std::to_string(vessel) + " in the model");
}

struct OwnStretch {
  double from_mm = 0.0, to_mm = 0.0;
};

/// Where a vessel runs by itself: behind its take-off, without a radius at its free ends, where the lumen
/// closes or opens to the aorta. `from` may be beyond `to`.
OwnStretch stretch_by_itself(const lumen::LumenModel& model, std::int32_t vessel) {
  std::vector<std::shared_ptr<const geometry::AxisCurve>> axes;
  for (const geometry::Vessel& one : model.tree.vessels) axes.push_back(lumen::vessel(model, one.id).axis);
  const std::size_t index = index_of(model, vessel);
  const geometry::AxisCurve& axis = *axes[index];
  const auto end_mm = [&](double s) { return axis.radius(s) > 0.0 ? axis.radius(s) : usual_end_mm; };
  const double branch = pipeline::free_from_mm(model.tree, axes, index);
  return {branch > 0.0 ? branch : end_mm(0.0), axis.length() - end_mm(axis.length())};
}

/// Rows whose wall is open take their neighbours'.
void fill_open_rows(segmentation::LumenBoundary& rows, std::vector<char>& known) {
  const auto ring = [&](int r) {
    return rows.radius_mm.begin() + static_cast<std::ptrdiff_t>(r) * rows.around;
  };
  const int count = rows.rows();
  for (int r = 1; r < count; ++r)
    if (!known[r] && known[r - 1]) std::copy_n(ring(r - 1), rows.around, ring(r)), known[r] = 1;
  for (int r = count - 2; r >= 0; --r)
    if (!known[r] && known[r + 1]) std::copy_n(ring(r + 1), rows.around, ring(r)), known[r] = 1;
}

}  // namespace

OwnLumen own_lumen(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                   std::int32_t vessel, double step_mm, int around, const core::TaskContext& task) {
  const OwnStretch own = stretch_by_itself(model, vessel);
  const geometry::AxisCurve& axis = *lumen::vessel(model, vessel).axis;
  OwnLumen out;
  out.vessel = vessel;
  out.rows.from_mm = own.from_mm;
  out.rows.step_mm = step_mm;
  out.rows.around = around;
  const int count = 1 + static_cast<int>(std::floor((own.to_mm - own.from_mm) / step_mm + same_place_mm));
  if (count < 2) return out;
  std::vector<char> known;
  for (int r = 0; r < count; ++r) {
    task.throw_if_cancelled();
    const double s = std::min(own.from_mm + r * step_mm, axis.length());
    const analysis::MeasuredSection section = analysis::measured_section(model, surface_of, vessel, s);
    known.push_back(section.measures.open ? 0 : 1);
    for (const double radius : radii_of(section.contour, axis, s, around))
      out.rows.radius_mm.push_back(std::max(radius, shut_mm));
  }
  fill_open_rows(out.rows, known);
  out.rows.confidence.assign(out.rows.radius_mm.size(), 1.0F);
  return out;
}

segmentation::LumenBoundary rows_between(const segmentation::LumenBoundary& rows, int first, int last) {
  segmentation::LumenBoundary out;
  out.from_mm = rows.from_mm + first * rows.step_mm;
  out.step_mm = rows.step_mm;
  out.around = rows.around;
  const auto begin = static_cast<std::ptrdiff_t>(first) * rows.around,
             end = static_cast<std::ptrdiff_t>(last + 1) * rows.around;
  out.radius_mm.assign(rows.radius_mm.begin() + begin, rows.radius_mm.begin() + end);
  out.confidence.assign(rows.confidence.begin() + begin, rows.confidence.begin() + end);
  return out;
}

}  // namespace ostia::session
