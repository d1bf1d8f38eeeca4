// New vessels: what they have to be, the walls that they start with, and those that leave no other.

#include "editing/edit_kinds.h"
#include "editing/tree_editing.h"
#include "editing/wall_editing.h"
#include "start/start_walls.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>

namespace ostia::lumen {
namespace {

using core::mm_text;

constexpr double repeated_mm = 1e-3;
constexpr std::int32_t fewest_rays = 8, most_rays = 128;

void check_radius(double radius_mm, const std::string& which, const std::string& what) {
  if (!(radius_mm >= least_radius_mm) || radius_mm > farthest_mm)
    throw InvalidInput(what + ": " + which + " is " + mm_text(radius_mm) + "; choose " +
                       mm_text(least_radius_mm) + " to " + mm_text(farthest_mm));
}

}  // namespace

void check_new_vessel(const std::vector<Vec3>& points, const std::vector<double>& radius_mm,
                      const NewWall& wall, const std::string& what) {
  if (points.size() < 2)
    throw InvalidInput(what + ": a vessel needs a path of at least two points, this one has " +
                       std::to_string(points.size()));
  if (radius_mm.size() != points.size())
    throw InvalidInput(what + ": the path has " + std::to_string(points.size()) + " points and " +
                       std::to_string(radius_mm.size()) + " radii; give one a point");
  for (std::size_t i = 0; i < radius_mm.size(); ++i)
    check_radius(radius_mm[i], "radius " + std::to_string(i), what);
  if (wall.empty()) return;
  const auto rings = wall.radius_mm.size() / static_cast<std::size_t>(std::max(wall.around, 1));
  if (wall.around < fewest_rays || wall.around > most_rays || rings < 2 ||
      wall.radius_mm.size() % static_cast<std::size_t>(wall.around) != 0)
    throw InvalidInput(what + ": the wall has " + std::to_string(wall.radius_mm.size()) + " distances on " +
                       std::to_string(wall.around) +
                       " rays; give two whole rings or more, of 8 to 128 rays each");
  for (std::size_t i = 0; i < wall.radius_mm.size(); ++i)
    check_radius(wall.radius_mm[i], "distance " + std::to_string(i) + " of the wall", what);
}

RadialWall wall_of(const NewWall& wall, const StartVessel& start) {
  const int rings = static_cast<int>(wall.radius_mm.size()) / wall.around;
  WallTable table(start.own_from_mm, (start.axis->length() - start.own_from_mm) / (rings - 1), rings,
                  wall.around);
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < wall.around; ++k)
      table.at(ring, k) = wall.radius_mm[static_cast<std::size_t>(ring * wall.around + k)];
  return table;
}

EditOutcome apply_to(const LumenModel& model, const VesselAdd& edit) {
  TreeEdit tree(model, "vessel.add");
  check_name(model, edit.name, -1, tree.what());
  check_new_vessel(edit.points, edit.radius_mm, edit.wall, tree.what());
  check_points(edit.points, 2, tree.what());
  geometry::Centerline axis;
  for (std::size_t i = 0; i < edit.points.size(); ++i) {
    if (i > 0 && (edit.points[i] - axis.points.back()).norm() < repeated_mm) continue;
    axis.points.push_back(edit.points[i]);
    axis.radius.push_back(edit.radius_mm[i]);
  }
  if (axis.points.size() < 3)
    throw InvalidInput(tree.what() + ": a vessel needs three places at least that are apart from each other");
  if (const std::size_t merged = edit.points.size() - axis.points.size(); merged > 0)
    tree.notes.push_back(tree.what() + ": " + std::to_string(merged) +
                         " points were closer than 1e-3 mm and were merged");
  geometry::complete(axis);
  geometry::TreeNode from{tree.new_tree_id(), axis.points.front()},
      to{tree.new_tree_id(), axis.points.back()};
  geometry::TreeSegment segment{tree.new_tree_id(), from.id, to.id, std::move(axis)};
  const std::int32_t id = tree.new_tree_id();
  tree.tree().nodes.insert(tree.tree().nodes.end(), {from, to});
  tree.tree().vessels.push_back({id, edit.name, {segment.id}});
  tree.tree().segments.push_back(std::move(segment));
  if (!edit.wall.empty()) tree.start_with(id, edit.wall);
  return std::move(tree).finish(standing_samples);
}

}  // namespace ostia::lumen
