#include "joint.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

namespace ostia::reconstruction {
namespace {

constexpr double pi = std::numbers::pi;

Slot slot_of(const std::vector<Tube>& tubes, std::int32_t index, bool distal) {
  const Tube& tube = tubes[static_cast<std::size_t>(index)];
  Slot slot;
  slot.tube = index;
  slot.distal = distal;
  slot.radius = distal ? tube.radius.back() * tube.factor.back() : tube.radius.front() * tube.factor.front();
  const double ahead = std::min(2.0 * slot.radius, 0.5 * tube.length());
  const Vec3 here = distal ? tube.points.back() : tube.points.front();
  slot.direction = (at(tube, distal ? tube.length() - ahead : ahead).point - here).normalized();
  return slot;
}

/// Puts the trunk's two ends into one group.
void group_trunk(std::vector<Slot>& slots, double lambda) {
  std::size_t parent = slots.size();
  for (std::size_t i = 0; i < slots.size(); ++i) {
    const bool better = parent == slots.size() || (slots[i].distal && !slots[parent].distal) ||
                        (slots[i].distal == slots[parent].distal && slots[i].radius > slots[parent].radius);
    if (better) parent = i;
  }
  std::vector<Vec3> directions;
  std::vector<double> radii;
  std::vector<std::size_t> who;
  for (std::size_t i = 0; i < slots.size(); ++i) {
    if (i == parent) continue;
    directions.push_back(slots[i].direction);
    radii.push_back(slots[i].radius);
    who.push_back(i);
  }
  const std::int32_t best =
      trunk_of(-slots[parent].direction, slots[parent].radius, directions, radii, lambda);
  const std::size_t trunk = who[static_cast<std::size_t>(best)];
  std::int32_t next = 1;
  for (std::size_t i = 0; i < slots.size(); ++i) slots[i].group = i == parent || i == trunk ? 0 : next++;
}

/// Two unit vectors that make a right-handed frame with the axis.
std::array<Vec3, 2> across(const Vec3& axis) {
  const Vec3 first = geometry::initial_normal(axis);
  const Vec3 e = (first - first.dot(axis) * axis).normalized();
  return {e, axis.cross(e)};
}

double azimuth(const std::array<Vec3, 2>& basis, const Vec3& direction) {
  return std::atan2(direction.dot(basis[1]), direction.dot(basis[0]));
}

/// How well the branches lie round an axis: far from its poles, and apart from each other.
double merit(const std::vector<Slot>& slots, const Vec3& axis) {
  const auto basis = across(axis);
  double flattest = 1.0;
  std::vector<double> angles;
  for (const Slot& slot : slots) {
    flattest = std::min(flattest, slot.direction.cross(axis).norm());
    angles.push_back(azimuth(basis, slot.direction));
  }
  std::sort(angles.begin(), angles.end());
  double gap = angles.front() + 2.0 * pi - angles.back();
  for (std::size_t i = 1; i < angles.size(); ++i) gap = std::min(gap, angles[i] - angles[i - 1]);
  return flattest + 0.3 * gap * static_cast<double>(slots.size()) / (2.0 * pi);
}

Vec3 axis_of(const std::vector<Slot>& slots) {
  std::vector<Vec3> candidates;
  for (std::size_t i = 0; i < slots.size(); ++i)
    for (std::size_t k = i + 1; k < slots.size(); ++k) {
      const Vec3 normal = slots[i].direction.cross(slots[k].direction);
      if (normal.norm() > 1e-6) candidates.push_back(normal.normalized());
    }
  if (slots.size() > 3) {
    for (std::size_t i = candidates.size(); i-- > 0;)
      for (std::size_t k = 0; k < i; ++k)
        for (const double sign : {-1.0, 1.0}) {
          const Vec3 sum = candidates[i] + sign * candidates[k];
          if (sum.norm() > 0.1) candidates.push_back(sum.normalized());
        }
  } else if (slots.size() == 3 && candidates.size() == 3) {
    // The normal of three ends' plane, which is that of the fork where it is flat.
    const Vec3 plane =
        (slots[1].direction - slots[0].direction).cross(slots[2].direction - slots[0].direction);
    if (plane.norm() > 1e-6) candidates.push_back(plane.normalized());
  }
  if (candidates.empty()) return across(slots[0].direction)[0];
  if (slots.size() == 2) return candidates[0];
  std::size_t best = 0;
  double most = -1.0;
  for (std::size_t i = 0; i < candidates.size(); ++i) {
    const double value = merit(slots, candidates[i]);
    if (value < most + 1e-3) continue;
    most = value;
    best = i;
  }
  return candidates[best];
}

Vec3 turned(const Vec3& from, const Vec3& to, double angle) {
  const Vec3 side = (to - to.dot(from) * from);
  if (side.norm() < 1e-9) return from;
  return std::cos(angle) * from + std::sin(angle) * side.normalized();
}

/// The direction of the crotch between two neighbours: where their walls meet, for tubes of these radii.
Vec3 crotch(const Slot& a, const Slot& b, const Vec3& axis) {
  const auto basis = across(axis);
  const double from = azimuth(basis, a.direction);
  double gap = azimuth(basis, b.direction) - from;
  while (gap <= 0.0) gap += 2.0 * pi;
  const double middle = from + 0.5 * gap;
  const Vec3 halfway = std::cos(middle) * basis[0] + std::sin(middle) * basis[1];
  const double angle = std::acos(std::clamp(a.direction.dot(b.direction), -1.0, 1.0));
  // Towards a straight line, and beyond it, walls do not meet: the middle.
  const double bend = std::clamp((std::max(gap, angle) - 2.9) / (3.1 - 2.9), 0.0, 1.0);
  if (bend >= 1.0) return halfway;
  const double least = 0.02 * angle;
  const double share =
      std::clamp(std::atan2(std::sin(angle), b.radius / a.radius + std::cos(angle)), least, angle - least);
  const Vec3 met = turned(a.direction, b.direction, share);
  return turned(met, halfway, bend * std::acos(std::clamp(met.dot(halfway), -1.0, 1.0)));
}

/// A ring's point may not reach beyond the first part of any branch.
double allowed(const Joint& joint, const std::vector<Tube>& tubes, const Vec3& direction, double s) {
  for (const Slot& slot : joint.slots) {
    const Tube& tube = tubes[static_cast<std::size_t>(slot.tube)];
    const bool open = slot.distal ? tube.inlet : tube.outlet;
    const double along = direction.dot(slot.direction);
    if (along > 0.0) s = std::min(s, (open ? 0.6 : 0.35) * tube.length() / along);
  }
  return s;
}

void shape(Joint& joint, const std::vector<Tube>& tubes, const ReconstructionOptions& options) {
  group_trunk(joint.slots, options.lambda);
  const Vec3 axis = axis_of(joint.slots);
  const auto basis = across(axis);
  std::stable_sort(joint.slots.begin(), joint.slots.end(), [&](const Slot& a, const Slot& b) {
    return azimuth(basis, a.direction) < azimuth(basis, b.direction);
  });
  joint.field.emplace(tubes, joint.slots, options.blend);
  const double side = 2.0 * pi / options.sides;
  const double scale = std::sqrt(side / std::sin(side));
  const auto point = [&](const Vec3& direction) {
    const double s = allowed(joint, tubes, direction, joint.field->exit(joint.centre, direction, scale));
    return Vec3(joint.centre + s * direction);
  };
  joint.poles = {point(axis), point(-axis)};
  const std::size_t n = joint.slots.size();
  const int half = options.sides / 2;
  for (std::size_t i = 0; i < n; ++i) {
    const Vec3 middle = crotch(joint.slots[i], joint.slots[(i + 1) % n], axis);
    const double above = std::acos(std::clamp(middle.dot(axis), -1.0, 1.0));
    std::vector<Vec3>& arc = joint.arcs.emplace_back();
    for (int k = 1; k < half; ++k) {
      const double t = 2.0 * k / half;  // 0 and 2 at the poles, 1 at the crotch
      arc.push_back(point(t <= 1.0 ? turned(axis, middle, t * above)
                                   : turned(-axis, middle, (2.0 - t) * (pi - above))));
    }
  }
  for (std::size_t i = 0; i < n; ++i) {
    double most = 0.0;
    const auto look = [&](const Vec3& p) {
      most = std::max(most, (p - joint.centre).dot(joint.slots[i].direction));
    };
    for (const auto& p : joint.poles) look(p);
    for (const auto& p : joint.arcs[i]) look(p);
    for (const auto& p : joint.arcs[(i + n - 1) % n]) look(p);
    joint.clearance.push_back(most);
  }
}

}  // namespace

std::vector<Joint> joints_of(const std::vector<Tube>& tubes, const geometry::VesselGraph& graph,
                             const ReconstructionOptions& options) {
  std::map<std::int32_t, std::vector<Slot>> at_point;
  for (std::size_t i = 0; i < tubes.size(); ++i) {
    const auto index = static_cast<std::int32_t>(i);
    if (!tubes[i].inlet) at_point[tubes[i].start].push_back(slot_of(tubes, index, false));
    if (!tubes[i].outlet) at_point[tubes[i].end].push_back(slot_of(tubes, index, true));
  }
  std::vector<Joint> joints;
  for (auto& [point, slots] : at_point) {
    Joint joint;
    joint.centre = graph.points[static_cast<std::size_t>(point)];
    joint.slots = std::move(slots);
    joints.push_back(std::move(joint));
  }
  core::parallel_for(joints.size(), 8, [&](std::size_t j) { shape(joints[j], tubes, options); });
  return joints;
}

}  // namespace ostia::reconstruction
