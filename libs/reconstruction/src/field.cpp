#include "field.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace ostia::reconstruction {
namespace {

constexpr double reach_in_radii = 16.0;

}  // namespace

JointField::JointField(const std::vector<Tube>& tubes, const std::vector<Slot>& slots, double blend)
    : blend_(blend) {
  double widest = 0.0;
  std::int32_t groups = 0;
  for (const Slot& slot : slots) {
    widest = std::max(widest, slot.radius);
    groups = std::max(groups, slot.group + 1);
  }
  reach_ = reach_in_radii * widest;
  for (std::int32_t g = 0; g < groups; ++g) {
    Group group;
    for (const Slot& slot : slots) {
      if (slot.group != g) continue;
      group.radius = std::max(group.radius, slot.radius);
      const Tube& tube = tubes[static_cast<std::size_t>(slot.tube)];
      const double most = std::max(std::min(reach_, 0.6 * tube.length()), tube.abscissa[1]);
      group.runs.push_back(add_run(tube, slot.distal, most));
    }
    if (!group.runs.empty()) groups_.push_back(std::move(group));
  }
}

JointField::Run JointField::add_run(const Tube& tube, bool distal, double most) {
  Run run{cones_.size(), 0, 0.0, distal};
  const std::size_t segments = tube.points.size() - 1;
  for (std::size_t k = 0; k < segments; ++k) {
    const std::size_t i = distal ? segments - 1 - k : k;
    const double near = distal ? tube.length() - tube.abscissa[i + 1] : tube.abscissa[i];
    if (near >= most) break;
    const Vec3 axis = tube.points[i + 1] - tube.points[i];
    const double ra = tube.radius[i] * tube.factor[i], rb = tube.radius[i + 1] * tube.factor[i + 1];
    cones_.push_back({tube.points[i], axis, ra, rb, 1.0 / axis.squaredNorm(), near,
                      near + tube.abscissa[i + 1] - tube.abscissa[i]});
    run.widest = std::max({run.widest, ra, rb});
  }
  run.last = cones_.size();
  return run;
}

/// Of cones that are equally near, the first along the branch, then the first branch.
void JointField::look(const Run& run, const Vec3& point, double scale, Nearest& nearest) const {
  Nearest own{nearest.value, 1.0, Vec3::Zero()};
  bool found = false;
  double clear = 0.0;  // all cones that end before are further away than the nearest so far
  for (std::size_t i = run.first; i < run.last; ++i) {
    const Cone& cone = cones_[i];
    if (cone.far < clear) continue;
    const Vec3 d = point - cone.a;
    const double t = std::clamp(d.dot(cone.axis) * cone.inverse_square, 0.0, 1.0);
    const Vec3 away = d - t * cone.axis;
    const double length = away.norm();
    const double value = length - scale * ((1.0 - t) * cone.ra + t * cone.rb);
    if (value < own.value || (found && run.distal && value == own.value)) {
      own = {value, length, away};
      found = true;
    }
    // Along the branch the distance falls no quicker than one goes; a little less, for rounding.
    clear = cone.near + (1.0 - 1e-6) * (length - scale * run.widest - own.value);
  }
  if (found) nearest = own;
}

FieldValue JointField::of(const Group& group, const Vec3& point, double scale) const {
  Nearest nearest{std::numeric_limits<double>::infinity(), 1.0, Vec3::UnitX()};
  for (const Run& run : group.runs) look(run, point, scale, nearest);
  return {nearest.value, nearest.length > 0.0 ? Vec3(nearest.away / nearest.length) : Vec3::UnitX()};
}

FieldValue JointField::operator()(const Vec3& point, double scale) const {
  FieldValue sum = of(groups_[0], point, scale);
  double radius = groups_[0].radius;
  for (std::size_t g = 1; g < groups_.size(); ++g) {
    const FieldValue next = of(groups_[g], point, scale);
    // Rounded only where the walls meet at an angle: where they are one wall it would bulge.
    const double apart = std::clamp(2.0 * (1.0 - sum.gradient.dot(next.gradient)), 0.0, 1.0);
    const double k = blend_ * apart * std::min(radius, groups_[g].radius);
    radius = std::max(radius, groups_[g].radius);
    // The quadratic smooth minimum: exact where the two differ by more than k.
    const double h = k > 0.0 ? std::clamp(0.5 + 0.5 * (next.distance - sum.distance) / k, 0.0, 1.0)
                             : (next.distance < sum.distance ? 0.0 : 1.0);
    sum.distance = h * sum.distance + (1.0 - h) * next.distance - k * h * (1.0 - h);
    sum.gradient = h * sum.gradient + (1.0 - h) * next.gradient;
  }
  return sum;
}

Vec3 JointField::onto(Vec3 point, double scale) const {
  for (int i = 0; i < 12; ++i) {
    const FieldValue value = (*this)(point, scale);
    if (std::abs(value.distance) < 1e-6 * groups_[0].radius) break;
    // In a narrow crotch two gradients cancel: then only a part of the step is taken.
    point -= value.distance * value.gradient / std::max(0.25, value.gradient.squaredNorm());
  }
  return point;
}

double JointField::exit(const Vec3& centre, const Vec3& direction, double scale) const {
  double s = 0.0;
  for (int i = 0; i < 400 && s < reach_; ++i) {
    const double value = (*this)(centre + s * direction, scale).distance;
    if (value > -1e-5 * groups_[0].radius) break;
    s -= value;
  }
  return s;
}

}  // namespace ostia::reconstruction
