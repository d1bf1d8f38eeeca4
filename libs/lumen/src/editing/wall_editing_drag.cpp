#include "editing/edit_kinds.h"
#include "editing/wall_editing.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::lumen {
namespace {

using core::mm_text;

// A sample of the wall seen from the place that is dragged: its way there on the wall, developed into a
// plane.
struct Neighbour {
  std::size_t index = 0;
  double distance_mm = 0.0;
  Vec3 away = Vec3::Zero();  // unit, along the wall, away from the dragged place
};

void check(const WallDrag& edit, const std::string& what) {
  check_points({edit.from, edit.to}, 2, what);
  if (!(edit.reach_mm > 0.0 && edit.reach_mm <= 20.0))
    throw InvalidInput(what + ": the reach is " + mm_text(edit.reach_mm) +
                       "; it must be above 0 and at most 20 mm");
}

// The sample nearest to a place among those of the stretches: its foot tells which part of the vessel is
// meant.
struct NearestSample {
  std::int32_t owner = 0;
  std::size_t index = 0;
  double distance_mm = std::numeric_limits<double>::infinity();
};
NearestSample nearest_sample(WallEdit& work, const Vec3& place) {
  NearestSample nearest;
  for (const OwnedStretch& stretch : work.stretches()) {
    const VesselLumen& owner = work.of(stretch.owner).vessel();
    for (std::size_t i = 0; i < owner.samples.size(); ++i) {
      const SurfaceSample& sample = owner.samples[i];
      if (sample.s_mm < stretch.from_mm || sample.s_mm >= stretch.to_mm) continue;
      const double distance = (sample.position - place).norm();
      if (distance < nearest.distance_mm) nearest = {stretch.owner, i, distance};
    }
  }
  return nearest;
}

geometry::AxisFoot foot_of(const AxisCurve& axis, const Vec3& place, double s_mm) {
  if (const auto foot = axis.foot_near(place, s_mm, 3.0)) return *foot;
  return axis.nearest_foot(place);
}

std::vector<Neighbour> neighbours(const VesselLumen& owner, const OwnedStretch& stretch, const Vec3& from,
                                  const geometry::AxisFoot& foot, double reach_mm) {
  const AxisCurve& axis = *owner.axis;
  std::vector<Neighbour> found;
  for (std::size_t i = 0; i < owner.samples.size(); ++i) {
    const SurfaceSample& sample = owner.samples[i];
    if (sample.s_mm < stretch.from_mm || sample.s_mm >= stretch.to_mm) continue;
    Neighbour neighbour{i, 0.0, Vec3::Zero()};
    const geometry::Frame frame = axis.frame(sample.s_mm);
    const Vec3 offset = sample.position - axis.point(sample.s_mm);
    const double past = offset.dot(frame.tangent);  // of a cap's sample
    const double rho = (offset - past * frame.tangent).norm();
    const double theta = geometry::angle_of(frame, offset);
    const double along = sample.s_mm + past - foot.s_mm;
    const double aside = 0.5 * (rho + foot.rho_mm) * angle_between(theta, foot.theta);
    neighbour.distance_mm = std::max(std::hypot(along, aside), (sample.position - from).norm());
    if (neighbour.distance_mm >= reach_mm) continue;
    const Vec3 around = geometry::radial_direction(frame, theta + 0.5 * std::numbers::pi);
    const Vec3 away = along * frame.tangent + aside * around;
    if (away.norm() > 1e-9) neighbour.away = away.normalized();
    found.push_back(neighbour);
  }
  return found;
}

// 1 at the dragged place, 0 from the reach on, with slopes of 0 at both.
double share(double x) {
  return x < 1.0 ? (1.0 - x * x) * (1.0 - x * x) : 0.0;
}
double share_slope(double x) {
  return x < 1.0 ? -4.0 * x * (1.0 - x * x) : 0.0;
}

// The normal of a wall moved by share(x) * shift: the inverse transposed Jacobian of that motion on it.
Vec3 moved_normal(const Vec3& normal, const Vec3& shift, const Vec3& gradient, const std::string& what) {
  const double stretch = 1.0 + shift.dot(gradient);
  if (stretch < 0.2)
    throw InvalidInput(what +
                       " moves the wall along itself farther than it can follow; drag across the wall, "
                       "or choose a larger reach");
  return (normal - (shift.dot(normal) / stretch) * gradient).normalized();
}

// The wall's direction at a place between samples.
Vec3 normal_at(const std::vector<SurfaceSample>& samples, const std::vector<Neighbour>& around,
               const Vec3& otherwise, double spacing_mm) {
  Vec3 sum = 1e-6 * otherwise;
  for (const Neighbour& neighbour : around) {
    const double x = neighbour.distance_mm / (2.0 * spacing_mm);
    if (x < 1.0) sum += std::pow(1.0 - x, 2) * samples[neighbour.index].normal;
  }
  return sum.norm() > 1e-9 ? Vec3(sum.normalized()) : otherwise;
}

void move(WallChange& change, const std::vector<Neighbour>& around, const WallDrag& edit, double too_near_mm,
          const std::string& what) {
  const Vec3 shift = edit.to - edit.from;
  const VesselLumen& owner = change.vessel();
  for (const Neighbour& neighbour : around) {
    const SurfaceSample& before = owner.samples[neighbour.index];
    change.remove(neighbour.index);
    if (neighbour.distance_mm < too_near_mm) continue;  // the dragged place stands for it
    const double x = neighbour.distance_mm / edit.reach_mm;
    SurfaceSample sample = before;
    sample.position += share(x) * shift;
    sample.normal = moved_normal(before.normal, shift, share_slope(x) / edit.reach_mm * neighbour.away, what);
    sample.s_mm = sample.origin == SampleOrigin::cap
                      ? before.s_mm
                      : foot_of(*owner.axis, sample.position, before.s_mm).s_mm;
    if (sample.origin != SampleOrigin::cap) sample.origin = SampleOrigin::edit;
    change.add(sample);
  }
}

}  // namespace

EditOutcome apply_to(const LumenModel& model, const WallDrag& edit) {
  WallEdit work(model, edit.vessel, "wall.drag");
  check(edit, work.what());
  if (!((edit.to - edit.from).norm() > 1e-6)) {
    work.notes.push_back("the wall was dragged nowhere; nothing changed");
    return std::move(work).outcome();
  }
  const NearestSample nearest = nearest_sample(work, edit.from);
  WallChange& change = work.of(nearest.owner);
  const VesselLumen& owner = change.vessel();
  const SurfaceSample& beside = owner.samples[nearest.index];
  const geometry::AxisFoot foot = foot_of(*owner.axis, edit.from, beside.s_mm);
  const double spacing = sample_spacing_mm(owner, foot.rho_mm);
  if (nearest.distance_mm > std::max(1.0, 2.0 * sample_spacing_mm(owner, farthest_mm)))
    throw InvalidInput(work.what() + " starts " + mm_text(nearest.distance_mm) +
                       " from the vessel's wall; take hold of the wall itself");
  if ((edit.to - edit.from).norm() > farthest_mm)
    throw InvalidInput(work.what() + " moves the wall by more than " + mm_text(farthest_mm) +
                       "; drag it in steps");
  const double left = foot_of(*owner.axis, edit.to, foot.s_mm).rho_mm;
  if (left < least_radius_mm)
    throw InvalidInput(work.what() + " ends " + mm_text(left) + " from the axis; keep the wall at least " +
                       mm_text(least_radius_mm) + " away, or move the axis first");
  const double too_near = std::min(0.5 * spacing, 0.5 * edit.reach_mm);
  if (edit.reach_mm < 1.5 * spacing)
    work.notes.push_back("the reach of " + mm_text(edit.reach_mm) +
                         " is shorter than one and a half times the wall's " + mm_text(spacing) +
                         " between samples: the wall follows as smoothly as they allow");

  for (const OwnedStretch& stretch : work.stretches()) {
    WallChange& part = work.of(stretch.owner);
    const geometry::AxisFoot own_foot = foot_of(*part.vessel().axis, edit.from, foot.s_mm);
    const std::vector<Neighbour> around =
        neighbours(part.vessel(), stretch, edit.from, own_foot, edit.reach_mm);
    move(part, around, edit, too_near, work.what());
    if (stretch.owner != nearest.owner || beside.s_mm < stretch.from_mm || beside.s_mm >= stretch.to_mm)
      continue;
    SurfaceSample pulled;
    pulled.position = edit.to;
    pulled.normal = normal_at(owner.samples, around, beside.normal, spacing);
    pulled.s_mm =
        beside.origin == SampleOrigin::cap ? beside.s_mm : foot_of(*owner.axis, edit.to, foot.s_mm).s_mm;
    pulled.origin = beside.origin == SampleOrigin::cap ? SampleOrigin::cap : SampleOrigin::edit;
    part.add(pulled);
  }
  return std::move(work).outcome();
}

}  // namespace ostia::lumen
