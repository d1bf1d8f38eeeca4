#include "editing/drawn_curve.h"
#include "editing/edit_kinds.h"
#include "editing/wall_editing.h"
#include "wall/between.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::lumen {

using core::mm_text;
using geometry::AxisFoot;

namespace {

using std::numbers::pi;
constexpr double least_stroke_gap_mm = 0.25;  // between points of a stroke: nearer ones are one shaky hand
constexpr double back_mm = 0.25;              // so much may a stroke run back along the vessel
constexpr double dense_step_mm = 0.05;        // of the line that T* is made from
constexpr double crowded_stroke_share = 0.3;

void check(const CprStroke& edit, const std::string& what) {
  check_points(edit.points, 2, what);
  if (!(edit.beta_deg >= 45.0 && edit.beta_deg <= 90.0))
    throw InvalidInput(what + ": beta is " + std::to_string(edit.beta_deg) +
                       " degrees; it must be from 45 to 90");
  if (!std::isfinite(edit.theta_deg)) throw InvalidInput(what + ": the angle of the plane is not finite");
}

double rho_of(const Vec3& coordinates) {
  return std::hypot(coordinates.y(), coordinates.z());
}
double theta_of(const Vec3& coordinates) {
  return std::atan2(coordinates.z(), coordinates.y());
}

// A line in a vessel's own coordinates, from the proximal to the distal end.
std::vector<Vec3> coordinates_of(const CprStroke& edit, const AxisCurve& axis, const std::string& what,
                                 std::vector<std::string>& notes) {
  std::optional<double> plane;
  if (edit.mode == ReformationMode::straightened) plane = edit.theta_deg / 180.0 * pi;
  std::vector<Vec3> points = merged_neighbours(edit.points, least_stroke_gap_mm, false);
  const std::vector<AxisFoot> feet = feet_along(axis, points, plane, what);
  for (std::size_t i = 0; i < points.size(); ++i) points[i] = straightened(axis, points[i], feet[i]);
  if (points.front().x() > points.back().x()) std::reverse(points.begin(), points.end());
  if (points.size() < 2 || points.back().x() - points.front().x() < least_stroke_gap_mm)
    throw InvalidInput(what + " covers less than " + mm_text(least_stroke_gap_mm) +
                       " of the vessel's length; draw it along the vessel, or use section.contour");
  if (points.size() < edit.points.size())
    notes.push_back(std::to_string(edit.points.size() - points.size()) +
                    " points of the stroke were nearer than " + mm_text(least_stroke_gap_mm) +
                    " to their neighbours and were merged");
  return points;
}

void check_course(const std::vector<Vec3>& line, const std::string& what) {
  std::vector<Vec2> flat;
  double turn = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    if (rho_of(line[i]) < least_radius_mm)
      throw InvalidInput(what + " comes within " + mm_text(least_radius_mm) + " of the axis at " +
                         mm_text(line[i].x()) + " along the vessel; draw each side of the wall by itself");
    const double step = i > 0 ? angle_between(theta_of(line[i]), theta_of(line[i - 1])) : 0.0;
    if (std::abs(step) > 0.5 * pi)
      throw InvalidInput(what + " crosses the axis near " + mm_text(line[i].x()) +
                         " along the vessel; draw each side of the wall by itself");
    turn += step;
    flat.emplace_back(line[i].x(), rho_of(line[i]) + 1e-9 * turn);
  }
  if (const auto crossing = self_crossing(flat, false))
    throw InvalidInput(what + " crosses itself near " + mm_text(line[crossing->first].x()) +
                       " along the vessel; draw it without a loop");
  double farthest = line.front().x();
  for (const Vec3& place : line) {
    farthest = std::max(farthest, place.x());
    if (farthest - place.x() > back_mm)
      throw InvalidInput(what + " runs back along the vessel at " + mm_text(farthest) +
                         "; draw it in one direction, or use section.contour");
  }
}

// The stroke as a curve where the vessel is straight: between its points it follows the bends of the vessel.
struct Stroke {
  DrawnCurve curve;
  std::vector<Vec3> dense;
};

Stroke stroke_of(const std::vector<Vec3>& points, const std::string& what) {
  check_course(points, what);
  DrawnCurve curve(points, false);
  const auto pieces = static_cast<int>(std::max(1.0, std::ceil(curve.length() / dense_step_mm)));
  std::vector<Vec3> dense;
  for (int i = 0; i <= pieces; ++i) dense.push_back(curve.at(curve.length() * i / pieces).point);
  check_course(dense, what);
  return {std::move(curve), std::move(dense)};
}

// A place of the stroke on the owner's axis.
AxisFoot foot_on(const AxisCurve& axis, const Vec3& place, double s_mm) {
  if (const auto foot = axis.foot_near(place, s_mm, 2.0)) return *foot;
  AxisFoot foot;
  foot.s_mm = std::clamp(s_mm, 0.0, axis.length());
  return foot;
}

Vec3 direction_in_world(const AxisCurve& axis, const CurvePlace& place) {
  constexpr double step = 1e-4;
  return (bent(axis, place.point + step * place.tangent) - bent(axis, place.point - step * place.tangent))
      .normalized();
}

// Outwards, across the stroke, tilted within the cross-section.
Vec3 stroke_normal(const geometry::Frame& frame, double theta, const Vec3& direction, double tilt) {
  const Vec3 radial = geometry::radial_direction(frame, theta);
  const Vec3 around = geometry::radial_direction(frame, theta + 0.5 * pi);
  const Vec3 outwards = (radial - radial.dot(direction) * direction).normalized();
  Vec3 aside = direction.cross(outwards);
  if (aside.dot(around) < 0.0) aside = -aside;
  return (outwards + std::tan(tilt) * aside).normalized();
}

// A line drawn again over itself keeps its normals: what stood beside the first has gone.
const SurfaceSample* drawn_before(const std::vector<WallPlace>& before, const SurfaceSample& sample,
                                  const Vec3& direction) {
  constexpr double same = 1e-3;
  for (const WallPlace& place : before) {
    const SurfaceSample& old = *place.sample;
    if (old.origin == SampleOrigin::edit && (old.position - sample.position).norm() < same &&
        std::abs(old.normal.dot(direction)) < same)
      return &old;
  }
  return nullptr;
}

// The stretch of a stroke whose wall one vessel's samples make.
void redraw(WallChange& change, const OwnedStretch& stretch, const Stroke& stroke, const AxisCurve& drawn_on,
            const CprStroke& edit) {
  const VesselLumen& vessel = change.vessel();
  const AxisCurve& axis = *vessel.axis;
  const auto belongs = [&](const Vec3& c) { return c.x() >= stretch.from_mm && c.x() < stretch.to_mm; };

  std::vector<LinePlace> line;
  double rho = 0.0;
  for (const Vec3& place : stroke.dense) {
    if (!belongs(place)) continue;
    const Vec3 world = bent(drawn_on, place);
    const double s =
        &axis == &drawn_on ? std::clamp(place.x(), 0.0, axis.length()) : foot_on(axis, world, place.x()).s_mm;
    line.push_back({s, world - axis.point(s)});
    rho += rho_of(place);
  }
  if (line.empty()) return;
  const double spacing = sample_spacing_mm(vessel, rho / static_cast<double>(line.size()));
  const TangentFrameBundle bundle(vessel.axis, line);
  StrokeReach reach{edit.beta_deg, 0.5 * spacing, vessel.own_from_mm, false, false};
  reach.start_cap = belongs(stroke.dense.front()) && stroke.dense.front().x() < 0.0;
  reach.end_cap = belongs(stroke.dense.back()) && stroke.dense.back().x() > axis.length();
  change.remove(contradicted(vessel.samples, bundle, reach));

  const std::vector<WallPlace> before =
      wall_places(vessel, bundle.from_mm() - 2.0 * spacing, bundle.to_mm() + 2.0 * spacing);
  std::vector<WallPlace> kept;
  for (const WallPlace& place : before)
    if (!change.removed(static_cast<std::size_t>(place.sample - vessel.samples.data())))
      kept.push_back(place);
  std::vector<SurfaceSample> drawn;
  for (const CurvePlace& place : stroke.curve.sampled(spacing)) {
    if (!belongs(place.point)) continue;
    SurfaceSample sample;
    sample.position = bent(drawn_on, place.point);
    sample.s_mm = &axis == &drawn_on ? std::clamp(place.point.x(), 0.0, axis.length())
                                     : foot_on(axis, sample.position, place.point.x()).s_mm;
    const geometry::Frame frame = axis.frame(sample.s_mm);
    const Vec3 direction = direction_in_world(drawn_on, place);
    if (const SurfaceSample* old = drawn_before(before, sample, direction)) {
      sample.normal = old->normal;
    } else {
      const double theta = geometry::angle_of(frame, sample.position - axis.point(sample.s_mm));
      const double tilt = tilt_at(before, kept, sample.s_mm, theta, rho_of(place.point), spacing);
      sample.normal = stroke_normal(frame, theta, direction, tilt);
    }
    sample.origin = SampleOrigin::edit;
    drawn.push_back(sample);
  }
  for (const SurfaceSample& sample : drawn) change.add(sample);
  for (const SurfaceSample& sample : samples_between(axis, kept, drawn, spacing)) change.add(sample);
  renew_caps(change);
  change.remove_crowded(crowded_stroke_share);
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const CprStroke& edit) {
  WallEdit work(model, edit.vessel, "cpr.stroke");
  check(edit, work.what());
  const AxisCurve& axis = *vessel(model, edit.vessel).axis;
  const Stroke stroke = stroke_of(coordinates_of(edit, axis, work.what(), work.notes), work.what());
  for (const OwnedStretch& stretch : work.stretches())
    redraw(work.of(stretch.owner), stretch, stroke, axis, edit);
  return std::move(work).outcome();
}

}  // namespace ostia::lumen
