#include "ostia/pipeline/ends_kept.h"

#include "intake/intake_ends.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;
using meshing::GivenEnd;

constexpr double end_reach_radii = 3.0;  // an axis may begin or end so far before its end

std::vector<Vec3> ends_of_axes(const geometry::VesselTree& tree) {
  std::vector<Vec3> places;
  for (const std::int32_t id : geometry::roots(tree)) places.push_back(geometry::node(tree, id).position);
  for (const std::int32_t id : geometry::ends(tree)) places.push_back(geometry::node(tree, id).position);
  return places;
}

/// Those of the lumen as it is, and those that it has lost on the way.
std::vector<GivenEnd> ends_of_file(const Source& source) {
  std::vector<GivenEnd> all = source.ends;
  all.insert(all.end(), source.lost.begin(), source.lost.end());
  const auto loops = geometry::boundary_loops(source.surface);
  if (loops.size() <= source.ends.size()) return all;
  const geometry::AabbTree closed(geometry::fill_holes(source.surface).mesh);
  for (const auto& loop : loops) {
    const GivenEnd end = meshing::end_at_loop(source.surface, loop);
    const bool known = std::ranges::any_of(source.ends, [&](const GivenEnd& cap) {
      return (cap.centre - end.centre).norm() < 0.5 * cap.radius_mm;
    });
    if (!known && !meshing::is_hole_in_wall(closed, end)) all.push_back(end);
  }
  return all;
}

}  // namespace

std::vector<std::string> ends_without_axis(const Source& source, const geometry::VesselTree& tree) {
  const std::vector<Vec3> places = ends_of_axes(tree);
  std::vector<std::string> lost;
  for (const GivenEnd& end : ends_of_file(source)) {
    const bool reached = std::ranges::any_of(
        places, [&](const Vec3& p) { return (p - end.centre).norm() <= end_reach_radii * end.radius_mm; });
    if (!reached)
      lost.push_back("the surface's end is lost: " + words_of(end) +
                     ", has no axis (--target there gives it one)");
  }
  return lost;
}

}  // namespace ostia::pipeline
