#include "ostia/session/beating.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

namespace ostia::session {
namespace {

constexpr double axis_step_mm = 0.5;
constexpr double beside_mm = 0.5;       // a place beside the axis' start, which carries its first normal
constexpr double feet_reach_mm = 15.0;  // of the wall about an axis that a view along it may show
constexpr double most_outside = 0.1;    // of the wall's points
constexpr double not_known = std::numeric_limits<double>::quiet_NaN();

/// Straight between marks that rise; clamped to their ends.
double looked_up(const std::vector<double>& from, const std::vector<double>& to, double at) {
  if (at <= from.front()) return to.front();
  if (at >= from.back()) return to.back();
  const auto above = std::upper_bound(from.begin(), from.end(), at);
  const auto i = static_cast<std::size_t>(above - from.begin());
  const double t = (at - from[i - 1]) / (from[i] - from[i - 1]);
  return (1.0 - t) * to[i - 1] + t * to[i];
}

/// What is kept for a key, made at its first use. Nothing is held while it is made: the work may be done side
/// by side, and a thread that waits for its parts may be given another view that asks for the same.
template <class Kept, class Make>
const std::unique_ptr<const Kept>& made_once(std::mutex& lock,
                                             std::map<std::int32_t, std::unique_ptr<const Kept>>& all,
                                             std::int32_t key, const Make& make) {
  {
    const std::lock_guard guard(lock);
    if (const auto found = all.find(key); found != all.end()) return found->second;
  }
  std::unique_ptr<const Kept> made = make();
  const std::lock_guard guard(lock);
  return all.try_emplace(key, std::move(made)).first->second;
}

void check_place(const motion::CarriedPoints& wall) {
  const double outside = static_cast<double>(wall.outside()) / static_cast<double>(wall.size());
  if (outside < most_outside) return;
  char text[160];
  std::snprintf(
      text, sizeof text,
      "%.0f %% of this case's wall lie outside of the motion's cage: choose the motion that was made "
      "of this tree",
      100.0 * outside);
  throw InvalidInput(text);
}

}  // namespace

CarriedAxis::CarriedAxis(std::shared_ptr<const geometry::AxisCurve> curve, std::vector<double> template_mm,
                         std::vector<double> here_mm)
    : curve_(std::move(curve)), template_mm_(std::move(template_mm)), here_mm_(std::move(here_mm)) {}
double CarriedAxis::here(double template_mm) const {
  return looked_up(template_mm_, here_mm_, template_mm);
}
double CarriedAxis::at_template(double here_mm) const {
  return looked_up(here_mm_, template_mm_, here_mm);
}

ShownPhase::ShownPhase(std::shared_ptr<const Beating> beating, double phase)
    : beating_(std::move(beating)),
      phase_(phase - std::floor(phase)),
      control_points_(beating_->cage().at(phase_)) {
  auto wall = std::make_shared<geometry::TriMesh>();
  wall->triangles = beating_->wall().triangles;
  wall->points = beating_->wall_points_.places(control_points_);
  wall_ = std::move(wall);
}

double ShownPhase::template_phase() const {
  return beating_->motion().template_phase;
}

const CarriedAxis& ShownPhase::axis(std::int32_t vessel) const {
  return *made_once(making_, axes_, vessel, [&] { return beating_->carried_axis(vessel, control_points_); });
}

Beating::Beating(const geometry::CageMotion& motion, std::shared_ptr<const lumen::LumenModel> model,
                 geometry::TriMesh wall)
    : motion_(motion),
      model_(std::move(model)),
      wall_(std::move(wall)),
      cage_(motion_),
      wall_points_(motion_.grid, wall_.points) {}

std::shared_ptr<const Beating> Beating::made(const geometry::CageMotion& motion,
                                             std::shared_ptr<const lumen::LumenModel> model,
                                             geometry::TriMesh wall) {
  if (!model || wall.points.empty()) throw InvalidInput("a motion needs a tree that it moves");
  std::shared_ptr<Beating> made(new Beating(motion, std::move(model), std::move(wall)));
  check_place(made->wall_points_);
  return made;
}

std::shared_ptr<const ShownPhase> Beating::at(double phase) const {
  if (!std::isfinite(phase)) throw InvalidInput("the phase to be shown is not finite");
  return std::make_shared<const ShownPhase>(shared_from_this(), phase);
}

const Beating::AxisPoints& Beating::axis_points(std::int32_t vessel) const {
  return *made_once(making_, axis_points_, vessel, [&] {
    const geometry::AxisCurve& axis = *lumen::vessel(*model_, vessel).axis;
    const auto steps = static_cast<std::size_t>(std::max(2.0, std::ceil(axis.length() / axis_step_mm)));
    std::vector<double> s_mm, radius;
    std::vector<Vec3> points;
    for (std::size_t i = 0; i <= steps; ++i) {
      s_mm.push_back(axis.length() * static_cast<double>(i) / static_cast<double>(steps));
      points.push_back(axis.point(s_mm.back()));
      radius.push_back(axis.radius(s_mm.back()));
    }
    points.push_back(axis.place(0.0, 0.0, beside_mm));
    if (std::any_of(radius.begin(), radius.end(), [](double r) { return !(r > 0.0); })) radius.clear();
    return std::unique_ptr<const AxisPoints>(
        new AxisPoints{std::move(s_mm), motion::CarriedPoints(motion_.grid, points), std::move(radius)});
  });
}

std::unique_ptr<const CarriedAxis> Beating::carried_axis(std::int32_t vessel,
                                                         const std::vector<Vec3>& control_points) const {
  const AxisPoints& rest = axis_points(vessel);
  geometry::Centerline line;
  line.points = rest.points.places(control_points);
  const Vec3 beside = line.points.back();
  line.points.pop_back();
  line.radius = rest.radius;
  geometry::complete(line, beside - line.points.front());
  auto curve = std::make_shared<const geometry::AxisCurve>(line);
  std::vector<double> here = line.abscissa;  // along the chords, 0.01 % shorter than the curve
  for (double& s : here) s *= curve->length() / line.abscissa.back();
  return std::make_unique<const CarriedAxis>(std::move(curve), rest.s_mm, std::move(here));
}

const std::vector<double>& Beating::wall_feet(std::int32_t vessel) const {
  return *made_once(making_, wall_feet_, vessel, [&] {
    const geometry::AxisCurve& axis = *lumen::vessel(*model_, vessel).axis;
    std::vector<double> feet(wall_.points.size(), not_known);
    core::parallel_for(feet.size(), 1024, [&](std::size_t i) {
      const geometry::AxisFoot foot = axis.nearest_foot(wall_.points[i]);
      if (foot.rho_mm < feet_reach_mm) feet[i] = foot.s_mm;
    });
    return std::make_unique<const std::vector<double>>(std::move(feet));
  });
}

double phase_distance(double a, double b) {
  const double off = std::abs(a - b - std::floor(a - b));
  return std::min(off, 1.0 - off);
}

std::string percent_of_cycle(double phase) {
  return core::trimmed_text(std::round(1000.0 * phase) / 10.0, 1) + " %";
}

}  // namespace ostia::session
