#include "joint_choice.h"

#include "base_mesh.h"
#include "catmull_clark.h"

#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

namespace ostia::reconstruction {
namespace {

/// In the order in which they are tried: without poles that are not needed, rounder, with more room.
constexpr std::array<JointStyle, 17> styles{{{},
                                             {.gap = 2.0},
                                             {.blend = 2.0},
                                             {.blend = 3.3},
                                             {.disc = false},
                                             {.disc = false, .blend = 2.0},
                                             {.four_poles = false},
                                             {.four_poles = false, .even = false},
                                             {.disc = false, .even = false},
                                             {.disc = false, .gap = 2.0},
                                             {.blend = 3.3, .gap = 2.0},
                                             {.four_poles = false, .blend = 3.3},
                                             {.four_poles = false, .even = false, .blend = 3.3},
                                             {.disc = false, .gap = 5.0},
                                             {.disc = false, .even = false, .gap = 5.0},
                                             {.disc = false, .blend = 3.3, .gap = 5.0},
                                             {.four_poles = false, .gap = 5.0}}};

/// The part of a branch next to the joint.
Tube cut(const Tube& whole, bool distal, double length) {
  Tube part;
  const auto keep = [&](std::size_t i) {
    part.points.push_back(whole.points[i]);
    part.radius.push_back(whole.radius[i]);
    part.factor.push_back(whole.factor[i]);
  };
  for (std::size_t i = 0; i < whole.points.size(); ++i) {
    const double away = distal ? whole.length() - whole.abscissa[i] : whole.abscissa[i];
    if (away <= length) keep(i);
  }
  if (part.points.size() < 3) return whole;
  measure(part);
  return part;
}

struct JointPatch {
  std::vector<Tube> tubes;
  std::vector<Slot> slots;
};

JointPatch patch_of(const Joint& joint, const std::vector<Tube>& tubes) {
  JointPatch patch;
  for (std::size_t i = 0; i < joint.slots.size(); ++i) {
    Slot slot = joint.slots[i];
    const Tube& whole = tubes[static_cast<std::size_t>(slot.tube)];
    const bool ends_here = slot.distal ? whole.inlet : whole.outlet;
    const double most = (ends_here ? 1.0 : 0.95) * whole.length();
    Tube part = cut(whole, slot.distal, std::min(most, 2.0 * joint.clearance[i] + 6.0 * slot.radius));
    part.inlet = slot.distal;
    part.outlet = !slot.distal;
    slot.tube = static_cast<std::int32_t>(i);
    patch.tubes.push_back(std::move(part));
    patch.slots.push_back(slot);
  }
  return patch;
}

std::size_t crossings(const JointPatch& patch, const Vec3& centre, const ReconstructionOptions& options,
                      const JointStyle& style, int level) {
  const std::vector<Joint> joints{joint_at(centre, patch.slots, patch.tubes, options, style)};
  std::vector<std::int32_t> all(patch.tubes.size());
  std::iota(all.begin(), all.end(), 0);
  QuadMesh mesh = base_mesh(patch.tubes, all, joints, options);
  place(mesh, patch.tubes, joints, polygon_scale(options, 0));
  for (int l = 1; l <= std::max(1, level); ++l) {
    mesh = subdivided(mesh);
    place(mesh, patch.tubes, joints, polygon_scale(options, l));
  }
  return geometry::self_intersections({mesh.points, triangles_of(mesh)}).size();
}

JointStyle chosen(const Joint& joint, const std::vector<Tube>& tubes, const ReconstructionOptions& options,
                  int level) {
  const JointPatch patch = patch_of(joint, tubes);
  JointStyle best;
  std::size_t least = std::numeric_limits<std::size_t>::max();
  for (const JointStyle& style : styles) {
    if (joint.slots.size() != 4 && !style.four_poles) continue;
    const std::size_t count = crossings(patch, joint.centre, options, style, level);
    if (count >= least) continue;
    best = style;
    least = count;
    if (count == 0) break;
  }
  return best;
}

}  // namespace

JointStyles chosen_styles(const std::vector<Joint>& joints, const std::vector<std::int32_t>& points,
                          const std::vector<Tube>& tubes, const ReconstructionOptions& options, int level,
                          const core::TaskContext& task) {
  std::vector<const Joint*> wanted;
  for (const Joint& joint : joints)
    if (std::binary_search(points.begin(), points.end(), joint.point)) wanted.push_back(&joint);
  std::vector<JointStyle> found(wanted.size());
  core::parallel_for(wanted.size(), 1, [&](std::size_t i) {
    task.throw_if_cancelled();
    found[i] = chosen(*wanted[i], tubes, options, level);
  });
  JointStyles made;
  for (std::size_t i = 0; i < wanted.size(); ++i)
    if (found[i] != JointStyle()) made[wanted[i]->point] = found[i];
  return made;
}

}  // namespace ostia::reconstruction
