// The exact form of a case of the pressure experiment: axes, and sections r(s, theta) about them.

#include "ostia/core/error.h"
#include "ostia/experiments/pressure_plan.h"
#include "ostia/geometry/axis_curve.h"
#include "ostia/lumen/start_surface.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

constexpr double step_mm = 0.2;       // between points of an axis
constexpr double fork_arc_radii = 3;  // radius of a branch's turn, in the trunk's
constexpr double degrees = std::numbers::pi / 180.0;

/// A narrowing's course: 0 where it has not begun, 1 in its throat.
double depth_at(const PlannedStenosis& stenosis, double s_mm) {
  const double from_end = 0.5 * stenosis.length_mm - std::abs(s_mm - stenosis.at_mm);
  if (from_end <= 0.0) return 0.0;
  if (from_end >= stenosis.shoulder_mm) return 1.0;
  return 0.5 * (1.0 - std::cos(std::numbers::pi * from_end / stenosis.shoulder_mm));
}

/// From 0 to 1 over [from, to].
double passage(double s, double from, double to) {
  const double t = std::clamp((s - from) / (to - from), 0.0, 1.0);
  return t * t * (3.0 - 2.0 * t);
}

/// One vessel of a case by the length along the line that it would follow without narrowings.
class Form {
 public:
  Form(const PressureCase& one, int vessel) : case_(one), vessel_(vessel) {}

  bool holds(const PlannedStenosis& s) const {
    return s.vessel == vessel_ || (case_.fork_mm > 0.0 && s.at_mm < case_.fork_mm);
  }
  double length() const { return vessel_ == 0 ? case_.length_mm : case_.side_length_mm; }

  /// Of the circle of equal area.
  double radius(double s) const {
    double d = case_.diameter_mm * (1.0 - case_.taper * std::clamp(s / case_.length_mm, 0.0, 1.0));
    if (case_.fork_mm > 0.0) {
      const double room = 0.5 * case_.diameter_mm;
      if (vessel_ == 0)
        d += (case_.main_mm - d) * passage(s, case_.fork_mm - 0.5 * room, case_.fork_mm + 1.5 * room);
      else if (s > case_.fork_mm)
        d = case_.side_mm;
    }
    for (const PlannedStenosis& stenosis : case_.stenoses)
      if (holds(stenosis)) d *= 1.0 - stenosis.severity * depth_at(stenosis, s);
    return 0.5 * d;
  }
  /// Longer half axis over the radius of equal area.
  double oval(double s) const {
    double oval = 1.0;
    for (const PlannedStenosis& stenosis : case_.stenoses)
      if (holds(stenosis)) oval *= 1.0 + (stenosis.oval - 1.0) * depth_at(stenosis, s);
    return oval;
  }
  /// Of the line, 1/mm, to the side of +x.
  double turn(double s) const {
    if (case_.fork_mm > 0.0) {
      const double arc = fork_arc_radii * 0.5 * case_.diameter_mm;
      const double angle = degrees * (vessel_ == 0 ? -case_.main_deg : case_.side_deg);
      const bool within = s > case_.fork_mm && s < case_.fork_mm + arc * std::abs(angle);
      return within ? (angle < 0.0 ? -1.0 : 1.0) / arc : 0.0;
    }
    if (case_.bend_radius_mm <= 0.0) return 0.0;
    const double middle = case_.stenoses.empty() ? 0.5 * length() : case_.stenoses.front().at_mm;
    const double from = std::max(2.0, middle - 0.5 * case_.bend_length_mm);
    return s > from && s < from + case_.bend_length_mm ? 1.0 / case_.bend_radius_mm : 0.0;
  }
  /// The throat's way aside, in the line's own directions.
  std::pair<double, double> aside(double s) const {
    std::pair<double, double> at{0.0, 0.0};
    for (const PlannedStenosis& stenosis : case_.stenoses) {
      if (!holds(stenosis)) continue;
      const double by = stenosis.aside_mm * depth_at(stenosis, s);
      at.first += by * std::cos(degrees * stenosis.aside_deg);
      at.second += by * std::sin(degrees * stenosis.aside_deg);
    }
    return at;
  }

 private:
  const PressureCase& case_;
  int vessel_;
};

/// A vessel's axis with radii, and the line's length at each of its points.
struct FormAxis {
  geometry::Centerline line;
  std::vector<double> along;
};

FormAxis axis_of(const Form& form, double from, double to, Vec3 point, double angle) {
  FormAxis axis;
  const int steps = std::max(2, static_cast<int>(std::ceil((to - from) / step_mm)));
  constexpr int fine = 16;
  const double step = (to - from) / steps;
  for (int i = 0; i <= steps; ++i) {
    const double s = from + step * i;
    const Vec3 across(std::cos(angle), 0.0, -std::sin(angle));
    const auto [x, y] = form.aside(s);
    axis.line.points.push_back(point + x * across + y * Vec3::UnitY());
    axis.line.radius.push_back(form.radius(s));
    axis.along.push_back(s);
    for (int k = 0; k < fine && i < steps; ++k) {
      const double half = 0.5 * step / fine, turn = form.turn(s + step * (k + 0.5) / fine);
      angle += half * turn;
      point += 2.0 * half * Vec3(std::sin(angle), 0.0, std::cos(angle));
      angle += half * turn;
    }
  }
  geometry::complete(axis.line);
  return axis;
}

geometry::TreeSegment segment_of(std::int32_t id, std::int32_t from, std::int32_t to, const FormAxis& axis) {
  geometry::TreeSegment segment;
  segment.id = id;
  segment.from = from;
  segment.to = to;
  segment.axis = axis.line;
  return segment;
}

geometry::VesselTree tree_of(const PressureCase& one) {
  geometry::VesselTree tree;
  const Form main(one, 0);
  const auto node = [&](std::int32_t id, const Vec3& at) { tree.nodes.push_back({id, at}); };
  if (one.fork_mm <= 0.0) {
    const FormAxis axis = axis_of(main, 0.0, one.length_mm, Vec3::Zero(), 0.0);
    node(1, axis.line.points.front());
    node(2, axis.line.points.back());
    tree.segments = {segment_of(3, 1, 2, axis)};
    tree.vessels = {{4, "main", {3}}};
    return tree;
  }
  const Form side(one, 1);
  const FormAxis trunk = axis_of(main, 0.0, one.fork_mm, Vec3::Zero(), 0.0);
  const Vec3 fork = trunk.line.points.back();
  const FormAxis to_main = axis_of(main, one.fork_mm, one.length_mm, fork, 0.0);
  FormAxis to_side = axis_of(side, one.fork_mm, one.side_length_mm, fork, 0.0);
  to_side.line.radius.front() = to_side.line.radius[1];
  node(1, trunk.line.points.front());
  node(2, fork);
  node(3, to_main.line.points.back());
  node(4, to_side.line.points.back());
  tree.segments = {segment_of(5, 1, 2, trunk), segment_of(6, 2, 3, to_main), segment_of(7, 2, 4, to_side)};
  tree.vessels = {{8, "main", {5, 6}}, {9, "side", {5, 7}}};
  return tree;
}

/// The line's length where a vessel's axis has an abscissa: the points are evenly spaced along the line.
class AlongAxis {
 public:
  explicit AlongAxis(const geometry::AxisCurve& axis, const FormAxis& form) : along_(form.along) {
    double guess = 0.0;
    for (std::size_t i = 0; i < form.line.points.size(); ++i) {
      if (i > 0) guess += (form.line.points[i] - form.line.points[i - 1]).norm();
      const auto foot = axis.foot_near(form.line.points[i], std::min(guess, axis.length()), 1.0);
      at_.push_back(foot ? foot->s_mm : guess);
    }
  }
  double operator()(double s_mm) const {
    const auto above = std::upper_bound(at_.begin(), at_.end(), s_mm);
    if (above == at_.begin()) return along_.front();
    if (above == at_.end()) return along_.back();
    const auto i = static_cast<std::size_t>(above - at_.begin());
    const double t = (s_mm - at_[i - 1]) / std::max(1e-12, at_[i] - at_[i - 1]);
    return along_[i - 1] + t * (along_[i] - along_[i - 1]);
  }

 private:
  std::vector<double> at_, along_;
};

double ellipse_radius(double radius, double oval, double theta) {
  return radius / std::hypot(std::cos(theta) / oval, std::sin(theta) * oval);
}

}  // namespace

lumen::LumenModel pressure_model(const PressureCase& one) {
  const geometry::VesselTree tree = tree_of(one);
  std::vector<lumen::RadialWall> walls(tree.vessels.size());
  if (one.fork_mm <= 0.0) {
    const geometry::AxisCurve axis(geometry::vessel_axis(tree, tree.vessels.front()));
    const Form form(one, 0);
    const AlongAxis along(axis, axis_of(form, 0.0, one.length_mm, Vec3::Zero(), 0.0));
    walls.front() = [one, along](double s_mm, double theta) {
      const Form own(one, 0);
      const double s = along(s_mm);
      return ellipse_radius(own.radius(s), own.oval(s), theta);
    };
  }
  lumen::SamplingOptions dense;
  dense.spacing_mm = 0.6;
  dense.least_spacing_mm = 0.2;
  dense.least_around = 12;
  return lumen::model_of_walls(tree, walls, dense);
}

std::optional<hemodynamics::Network> exact_network(const PressureCase& one) {
  if (one.fork_mm > 0.0 || one.kind == PressureKind::patient) return std::nullopt;
  const geometry::VesselTree tree = tree_of(one);
  const geometry::AxisCurve axis(geometry::vessel_axis(tree, tree.vessels.front()));
  const Form form(one, 0);
  const AlongAxis along(axis, axis_of(form, 0.0, one.length_mm, Vec3::Zero(), 0.0));
  hemodynamics::Branch branch;
  branch.segment = tree.segments.front().id;
  branch.vessel = tree.vessels.front().id;
  branch.name = tree.vessels.front().name;
  constexpr double exact_step_mm = 0.25;
  const int steps = static_cast<int>(std::ceil(axis.length() / exact_step_mm));
  for (int i = 0; i <= steps; ++i) {
    hemodynamics::Station station;
    station.s_mm = axis.length() * i / steps;
    const double s = along(station.s_mm), radius = form.radius(s), oval = form.oval(s);
    station.area_mm2 = std::numbers::pi * radius * radius;
    station.shape = hemodynamics::shape_of_ellipse(radius * oval, radius / oval);
    station.curvature_per_mm = axis.curvature_vector(station.s_mm).norm();
    station.point = axis.point(station.s_mm);
    branch.stations.push_back(station);
  }
  return hemodynamics::Network{{branch}};
}

}  // namespace ostia::experiments
