// Rings that join a lumen to the outside of its wall.

#include "cutting/cap_regions.h"

#include "ostia/geometry/faces.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/flat_caps.h"

#include <algorithm>
#include <map>
#include <optional>
#include <tuple>
#include <utility>

namespace ostia::meshing {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

constexpr double coplanar_deg = 12.0;  // triangles of a ring meet at less

using Loop = std::vector<std::int32_t>;

/// A rim's loops; none where a point of it has not two of its edges.
std::vector<Loop> loops_of_rim(const Look& look, const std::vector<std::size_t>& rim) {
  std::map<std::int32_t, std::vector<std::int32_t>> next;
  for (const std::size_t k : rim) {
    next[look.edges[k].a].push_back(look.edges[k].b);
    next[look.edges[k].b].push_back(look.edges[k].a);
  }
  for (const auto& [point, others] : next)
    if (others.size() != 2) return {};
  std::vector<Loop> loops;
  while (!next.empty()) {
    Loop loop{next.begin()->first};
    for (std::int32_t at = loop.front();;) {
      const auto others = next.find(at);
      if (others == next.end()) break;
      const std::vector<std::int32_t> ways = others->second;
      next.erase(others);
      const auto on = std::ranges::find_if(ways, [&](std::int32_t p) { return next.contains(p); });
      if (on == ways.end()) break;
      loop.push_back(at = *on);
    }
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// As end_at_loop has it, but facing as the ring does.
GivenEnd end_within(const TriMesh& mesh, const Loop& loop, const Vec3& normal) {
  GivenEnd end = end_at_loop(mesh, loop);
  end.normal = normal;
  return end;
}

/// The lumen's end where the region is a flat ring with sharp rims.
std::optional<GivenEnd> end_in_ring(const Look& look, Region& region, const FlatCapOptions& options) {
  if (region.on_border || region.rim.size() < 2 * fewest_on_rim) return std::nullopt;
  measure(look, region);
  if (region.rim_deg < options.least_rim_deg) return std::nullopt;
  const std::vector<Loop> loops = loops_of_rim(look, region.rim);
  if (loops.size() != 2 || std::ranges::any_of(loops, [](const Loop& l) { return l.size() < fewest_on_rim; }))
    return std::nullopt;
  const GivenEnd one = end_within(look.mesh, loops[0], region.end.normal),
                 other = end_within(look.mesh, loops[1], region.end.normal);
  const GivenEnd &inner = one.radius_mm < other.radius_mm ? one : other,
                 &outer = one.radius_mm < other.radius_mm ? other : one;
  if (region.deviation_mm > options.flat_tolerance * outer.radius_mm ||
      (inner.centre - outer.centre).norm() > inner.radius_mm)
    return std::nullopt;
  return inner;
}

std::pair<std::string, std::optional<geometry::FaceKind>> name_of_ring(const geometry::FacedSurface& surface,
                                                                       const Region& ring) {
  if (surface.face_ids.empty()) return {};
  const std::int32_t id = surface.face_ids[static_cast<std::size_t>(ring.triangles.front())];
  const auto face = std::ranges::find(surface.faces, id, &geometry::Face::id);
  if (face == surface.faces.end() || geometry::is_wall(*face)) return {};
  const GivenEnd named = end_named(face->name);
  return {named.name, named.kind};
}

}  // namespace

OpenedRings without_flat_rings(const geometry::FacedSurface& surface, const FlatCapOptions& options,
                               const core::TaskContext& task) {
  validate(options);
  OpenedRings opened;
  const Look look(surface.mesh);
  task.throw_if_cancelled();
  std::vector<bool> keep(surface.mesh.triangles.size(), true);
  for (Region& region :
       regions(look, [&](const SharedEdge& e) { return look.angle_deg(e) < coplanar_deg; })) {
    std::optional<GivenEnd> end = end_in_ring(look, region, options);
    if (!end) continue;
    std::tie(end->name, end->kind) = name_of_ring(surface, region);
    opened.ends.push_back(std::move(*end));
    for (const std::int32_t t : region.triangles) keep[static_cast<std::size_t>(t)] = false;
  }
  opened.walls = opened.ends.empty() ? surface.mesh : geometry::subset(surface.mesh, keep);
  return opened;
}

}  // namespace ostia::meshing
