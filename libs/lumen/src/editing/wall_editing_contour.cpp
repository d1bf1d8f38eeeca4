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
namespace {

using core::mm_text;
using std::numbers::pi;
constexpr double least_gap_mm = 0.15;  // between points of a contour
constexpr double crowded_share = 0.3;
constexpr double steepest_slope = 1.5;  // of the wall along the axis, mm / mm

struct Section {
  const AxisCurve* axis = nullptr;
  double s_mm = 0.0;
  geometry::Frame frame;
  Vec3 centre = Vec3::Zero(), normal = Vec3::UnitX(), second = Vec3::UnitY();
  Vec2 flat(const Vec3& place) const { return {(place - centre).dot(normal), (place - centre).dot(second)}; }
};

Section section_at(const AxisCurve& axis, double s_mm) {
  Section section{&axis, s_mm, axis.frame(s_mm), axis.point(s_mm), {}, {}};
  section.normal = geometry::radial_direction(section.frame, 0.0);
  section.second = geometry::radial_direction(section.frame, 0.5 * pi);
  return section;
}

std::vector<Vec2> flat(const Section& section, const std::vector<Vec3>& points) {
  std::vector<Vec2> out;
  for (const Vec3& point : points) out.push_back(section.flat(point));
  return out;
}

void check(const SectionContour& edit, double length_mm, const std::string& what) {
  check_points(edit.points, 3, what);
  if (!(edit.eps_mm > 0.0 && edit.eps_mm <= 20.0))
    throw InvalidInput(what + ": eps is " + mm_text(edit.eps_mm) + "; it must be above 0 and at most 20 mm");
  if (!(edit.s_mm >= 0.0 && edit.s_mm <= length_mm))
    throw InvalidInput(what + ": the section at " + mm_text(edit.s_mm) + " is not on the vessel, which is " +
                       mm_text(length_mm) + " long");
}

void check_in_plane(const SectionContour& edit, const Section& section, const std::string& what) {
  const double most = std::max(0.5 * edit.eps_mm, 0.1);
  for (std::size_t i = 0; i < edit.points.size(); ++i) {
    const Vec3 offset = edit.points[i] - section.centre;
    const double off = std::abs(offset.dot(section.frame.tangent));
    if (off > most)
      throw InvalidInput(what + ": point " + std::to_string(i + 1) + " is " + mm_text(off) +
                         " off the section at " + mm_text(edit.s_mm) + ", more than " + mm_text(most) +
                         "; draw it on the section that it belongs to");
    if (offset.norm() > farthest_mm)
      throw InvalidInput(what + ": point " + std::to_string(i + 1) + " is " + mm_text(offset.norm()) +
                         " from the axis, more than " + mm_text(farthest_mm) +
                         "; choose the vessel that it belongs to");
  }
}

// The whole angle that a line turns about the axis, with the range that it covers on the way.
struct Turn {
  double whole = 0.0, lowest = 0.0, highest = 0.0, nearest_mm = 0.0;
};
Turn turn_of(const std::vector<Vec2>& line, bool closed) {
  Turn turn;
  turn.nearest_mm = line.front().norm();
  for (std::size_t i = 0; i + (closed ? 0 : 1) < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
    turn.whole += std::atan2(a.x() * b.y() - a.y() * b.x(), a.dot(b));
    turn.lowest = std::min(turn.lowest, turn.whole);
    turn.highest = std::max(turn.highest, turn.whole);
    const Vec2 way = b - a;
    const double t = way.squaredNorm() > 0.0 ? std::clamp(-a.dot(way) / way.squaredNorm(), 0.0, 1.0) : 0.0;
    turn.nearest_mm = std::min(turn.nearest_mm, (a + t * way).norm());
  }
  return turn;
}

double area_of(const std::vector<Vec2>& line) {
  double twice = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) {
    const Vec2 &a = line[i], &b = line[(i + 1) % line.size()];
    twice += a.x() * b.y() - a.y() * b.x();
  }
  return 0.5 * twice;
}

double length_of(const std::vector<Vec2>& line) {
  double length = 0.0;
  for (std::size_t i = 0; i < line.size(); ++i) length += (line[(i + 1) % line.size()] - line[i]).norm();
  return length;
}

void check_course(const std::vector<Vec2>& line, bool closed, const std::string& what) {
  if (self_crossing(line, closed)) throw InvalidInput(what + " crosses itself; draw it without a loop");
  if (closed && std::abs(area_of(line)) < 1e-3 * std::pow(length_of(line), 2))
    throw InvalidInput(what + " has no area; draw it around the lumen");
  const Turn turn = turn_of(line, closed);
  if (turn.nearest_mm < least_radius_mm)
    throw InvalidInput(what + " comes within " + mm_text(least_radius_mm) +
                       " of the axis; draw it around the axis, or move the axis first");
  if (closed && std::abs(turn.whole) < pi)
    throw InvalidInput(what +
                       " does not go around the axis; draw it around the axis, or move the axis first");
  if (!closed && turn.highest - turn.lowest >= 2.0 * pi)
    throw InvalidInput(what + " is open and goes around the axis more than once; close it");
}

std::vector<Vec2> dense(const Section& section, const DrawnCurve& curve) {
  std::vector<Vec2> line;
  const int pieces = static_cast<int>(std::clamp(std::ceil(curve.length() / 0.05), 16.0, 600.0));
  for (int i = 0; i < pieces + (curve.closed() ? 0 : 1); ++i)
    line.push_back(section.flat(curve.at(curve.length() * i / pieces).point));
  return line;
}

// Mean radius of the nearest wall on one side of the section, around an angle.
struct WallBeside {
  double s_mm = 0.0, rho_mm = 0.0;
};
std::optional<WallBeside> beside(const std::vector<WallPlace>& kept, double s_mm, double theta, double side,
                                 double spacing_mm) {
  constexpr double wide = 50.0 / 180.0 * pi;
  const auto weight_of = [&](const WallPlace& place) {
    const double aside = std::abs(angle_between(place.theta, theta)) / wide;
    return side * (place.sample->s_mm - s_mm) > 0.0 && aside < 1.0 ? 1.0 - aside : 0.0;
  };
  double least = 1e300;
  for (const WallPlace& place : kept)
    if (weight_of(place) > 0.0) least = std::min(least, std::abs(place.sample->s_mm - s_mm));
  WallBeside mean;
  double sum = 0.0;
  for (const WallPlace& place : kept) {
    if (std::abs(place.sample->s_mm - s_mm) > least + spacing_mm) continue;
    const double weight = weight_of(place);
    mean.s_mm += weight * place.sample->s_mm;
    mean.rho_mm += weight * place.rho_mm;
    sum += weight;
  }
  if (!(sum > 1e-9)) return std::nullopt;
  return WallBeside{mean.s_mm / sum, mean.rho_mm / sum};
}

// d rho / d s of the wall that the section cuts.
double slope_at(const std::vector<WallPlace>& kept, double s_mm, double theta, double spacing_mm) {
  const auto ahead = beside(kept, s_mm, theta, 1.0, spacing_mm);
  const auto behind = beside(kept, s_mm, theta, -1.0, spacing_mm);
  if (!ahead || !behind || ahead->s_mm - behind->s_mm < 1e-3) return 0.0;
  return std::clamp((ahead->rho_mm - behind->rho_mm) / (ahead->s_mm - behind->s_mm), -steepest_slope,
                    steepest_slope);
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const SectionContour& edit) {
  WallEdit work(model, edit.vessel, "section.contour");
  check(edit, vessel(model, edit.vessel).axis->length(), work.what());
  WallChange& change = work.of(work.stretch_at(edit.s_mm).owner);
  const VesselLumen& owner = change.vessel();
  const Section section = section_at(*owner.axis, edit.s_mm);
  check_in_plane(edit, section, work.what());
  const std::vector<Vec3> points = merged_neighbours(edit.points, least_gap_mm, edit.closed);
  check_points(points, 3, work.what() + ", points nearer than " + mm_text(least_gap_mm) + " merged,");
  if (points.size() < edit.points.size())
    work.notes.push_back(std::to_string(edit.points.size() - points.size()) +
                         " points of the contour were nearer than " + mm_text(least_gap_mm) +
                         " to their neighbours and were merged");
  check_course(flat(section, points), edit.closed, work.what());
  const DrawnCurve curve(points, edit.closed);
  const std::vector<Vec2> line = dense(section, curve);
  check_course(line, edit.closed, work.what());

  const Turn turn = turn_of(line, edit.closed);
  const double mean_radius = curve.length() / std::max(1.0, turn.highest - turn.lowest);
  const double spacing = sample_spacing_mm(owner, mean_radius);
  std::optional<AngularRange> range;
  const double half = 0.5 * spacing / mean_radius, covered = turn.highest - turn.lowest + 2.0 * half;
  if (!edit.closed && covered < 2.0 * pi)
    range = AngularRange{std::atan2(line.front().y(), line.front().x()) + turn.lowest - half, covered};
  change.remove(contradicted(owner.samples, *owner.axis, edit.s_mm, edit.eps_mm, range));

  const double reach = 0.5 * edit.eps_mm + 3.0 * spacing;
  std::vector<WallPlace> kept;
  for (const WallPlace& place : wall_places(owner, edit.s_mm - reach, edit.s_mm + reach))
    if (!change.removed(static_cast<std::size_t>(place.sample - owner.samples.data()))) kept.push_back(place);
  const double side = turn.whole > 0.0 ? 1.0 : -1.0;  // drawn in either sense: outwards is one
  for (const CurvePlace& place : curve.sampled(spacing)) {
    SurfaceSample sample;
    sample.position = place.point;
    sample.s_mm = edit.s_mm;
    sample.origin = SampleOrigin::edit;
    const Vec3& tangent = section.frame.tangent;
    const Vec2 at = section.flat(place.point);
    const double slope = slope_at(kept, edit.s_mm, std::atan2(at.y(), at.x()), spacing);
    // A line drawn counter-clockwise in (radial_direction(0), radial_direction(90 degrees)) has the outside
    // on its right; these two and the tangent are left-handed.
    const Vec3 outwards = tangent.cross(side * place.tangent);
    sample.normal = (outwards.normalized() - slope * tangent).normalized();
    change.add(sample);
  }
  renew_caps(change);
  change.remove_crowded(crowded_share);
  return std::move(work).outcome();
}

}  // namespace ostia::lumen
