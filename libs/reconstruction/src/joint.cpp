#include "joint.h"

#include "ostia/core/parallel.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace ostia::reconstruction {
namespace {

/// Of a branch's length, what its joints may take: all but a share of it, or of its radius where it is long.
double room_of(const Tube& tube, double share) {
  const double radius = std::min(tube.radius.front(), tube.radius.back());
  return tube.length() - std::min(share * tube.length(), 2.0 * share * radius);
}
constexpr double kept_of_own = 0.15, kept_of_shared = 0.2;

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

/// A ring's point may not go further along any branch than the branch has room for.
double allowed(const std::vector<Slot>& slots, const Vec3& direction, double s) {
  for (const Slot& slot : slots) {
    const double along = direction.dot(slot.direction);
    if (along > 0.0) s = std::min(s, slot.reach / along);
  }
  return s;
}

using Ends = std::vector<std::array<std::pair<std::int32_t, std::size_t>, 2>>;  // joint and slot, -1 for none

/// Where the joints at a branch's two ends have not enough room, they share it as they would need it. True
/// for the joints for which that changes something.
std::vector<std::uint8_t> share_room(std::vector<Joint>& joints, const std::vector<Tube>& tubes) {
  Ends ends(tubes.size(), {{{-1, 0}, {-1, 0}}});
  for (std::size_t j = 0; j < joints.size(); ++j)
    for (std::size_t i = 0; i < joints[j].slots.size(); ++i) {
      const Slot& slot = joints[j].slots[i];
      ends[static_cast<std::size_t>(slot.tube)][slot.distal ? 1 : 0] = {static_cast<std::int32_t>(j), i};
    }
  std::vector<std::uint8_t> changed(joints.size(), 0);
  for (std::size_t t = 0; t < tubes.size(); ++t) {
    if (ends[t][0].first < 0 || ends[t][1].first < 0) continue;
    std::array<double, 2> wanted{};
    for (std::size_t e = 0; e < 2; ++e)
      wanted[e] = joints[static_cast<std::size_t>(ends[t][e].first)].clearance[ends[t][e].second];
    const double room = room_of(tubes[t], kept_of_shared);
    if (wanted[0] + wanted[1] <= room) continue;
    for (std::size_t e = 0; e < 2; ++e) {
      const auto joint = static_cast<std::size_t>(ends[t][e].first);
      joints[joint].slots[ends[t][e].second].reach = room * wanted[e] / (wanted[0] + wanted[1]);
      changed[joint] = 1;
    }
  }
  return changed;
}

}  // namespace

Slot slot_of(const std::vector<Tube>& tubes, std::int32_t index, bool distal) {
  const Tube& tube = tubes[static_cast<std::size_t>(index)];
  Slot slot;
  slot.tube = index;
  slot.distal = distal;
  slot.radius = distal ? tube.radius.back() * tube.factor.back() : tube.radius.front() * tube.factor.front();
  const double ahead = std::min(2.0 * slot.radius, 0.5 * tube.length());
  slot.reach = room_of(tube, kept_of_own);
  const Vec3 here = distal ? tube.points.back() : tube.points.front();
  slot.direction = (at(tube, distal ? tube.length() - ahead : ahead).point - here).normalized();
  return slot;
}

Joint joint_at(const Vec3& centre, std::vector<Slot> slots, const std::vector<Tube>& tubes,
               const ReconstructionOptions& options, const JointStyle& style) {
  Joint joint;
  joint.centre = centre;
  joint.slots = std::move(slots);
  joint.style = style;
  group_trunk(joint.slots, options.lambda);
  joint.field.emplace(tubes, joint.slots, style.blend * options.blend);
  const double side = 2.0 * std::numbers::pi / options.sides;
  const double scale = std::sqrt(side / std::sin(side));
  const auto exit = [&](const Vec3& direction) {
    const double s = allowed(joint.slots, direction, joint.field->exit(joint.centre, direction, scale));
    return Vec3(joint.centre + s * direction);
  };
  const auto onto = [&](const Vec3& point) { return joint.field->onto(point, scale); };
  JointRings about = rings_about(joint.slots, options.sides, style, {joint.centre, exit, onto});
  joint.points = std::move(about.points);
  joint.rings = std::move(about.rings);
  joint.clearance = std::move(about.clearance);
  for (std::size_t i = joint.clearance.size(); i < joint.slots.size(); ++i) {
    double most = 0.0;
    for (const std::int32_t p : joint.rings[i])
      most = std::max(
          most, (joint.points[static_cast<std::size_t>(p)] - joint.centre).dot(joint.slots[i].direction));
    joint.clearance.push_back(most);
  }
  return joint;
}

std::vector<Joint> joints_of(const std::vector<Tube>& tubes, const TubeEnds& ends,
                             const std::vector<std::int32_t>& points, const geometry::VesselGraph& graph,
                             const ReconstructionOptions& options, const JointStyles& styles) {
  std::vector<std::int32_t> meeting;
  for (const std::int32_t point : points)
    if (!ends[static_cast<std::size_t>(point)].empty()) meeting.push_back(point);
  std::vector<Joint> joints(meeting.size());
  core::parallel_for(meeting.size(), 8, [&](std::size_t j) {
    std::vector<Slot> slots;
    for (const TubeEnd& end : ends[static_cast<std::size_t>(meeting[j])])
      slots.push_back(slot_of(tubes, end.tube, end.distal));
    const auto style = styles.find(meeting[j]);
    joints[j] = joint_at(graph.points[static_cast<std::size_t>(meeting[j])], std::move(slots), tubes, options,
                         style == styles.end() ? JointStyle() : style->second);
    joints[j].point = meeting[j];
  });
  const std::vector<std::uint8_t> changed = share_room(joints, tubes);
  core::parallel_for(joints.size(), 8, [&](std::size_t j) {
    if (changed[j] == 0) return;
    const std::int32_t point = joints[j].point;
    joints[j] = joint_at(joints[j].centre, std::move(joints[j].slots), tubes, options, joints[j].style);
    joints[j].point = point;
  });
  return joints;
}

}  // namespace ostia::reconstruction
