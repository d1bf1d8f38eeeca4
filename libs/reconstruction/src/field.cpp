#include "field.h"

#include <algorithm>
#include <cmath>
#include <limits>

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
    group.first = cones_.size();
    for (const Slot& slot : slots) {
      if (slot.group != g) continue;
      group.radius = std::max(group.radius, slot.radius);
      const Tube& tube = tubes[static_cast<std::size_t>(slot.tube)];
      const double most = std::max(std::min(reach_, 0.6 * tube.length()), tube.abscissa[1]);
      for (std::size_t i = 0; i + 1 < tube.points.size(); ++i) {
        const bool near = slot.distal ? tube.length() - tube.abscissa[i + 1] < most : tube.abscissa[i] < most;
        if (!near) continue;
        const Vec3 axis = tube.points[i + 1] - tube.points[i];
        cones_.push_back({tube.points[i], axis, tube.radius[i] * tube.factor[i],
                          tube.radius[i + 1] * tube.factor[i + 1], 1.0 / axis.squaredNorm()});
      }
    }
    group.last = cones_.size();
    if (group.last > group.first) groups_.push_back(group);
  }
}

FieldValue JointField::of(const Group& group, const Vec3& point, double scale) const {
  double least = std::numeric_limits<double>::infinity();
  Vec3 best = Vec3::UnitX();
  double best_length = 1.0;
  for (std::size_t i = group.first; i < group.last; ++i) {
    const Cone& cone = cones_[i];
    const Vec3 d = point - cone.a;
    const double t = std::clamp(d.dot(cone.axis) * cone.inverse_square, 0.0, 1.0);
    const Vec3 away = d - t * cone.axis;
    const double length = away.norm();
    const double value = length - scale * ((1.0 - t) * cone.ra + t * cone.rb);
    if (value >= least) continue;
    least = value;
    best = away;
    best_length = length;
  }
  return {least, best_length > 0.0 ? Vec3(best / best_length) : Vec3::UnitX()};
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
