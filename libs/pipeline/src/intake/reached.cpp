#include "ostia/pipeline/reached.h"

#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>
#include <limits>

namespace ostia::pipeline {
namespace {

using geometry::Vec3;

constexpr double near_in_radii = 2.0, near_besides_mm = 2.0;

std::string point_text(const Vec3& p) {
  return "(" + core::fixed_text(p.x(), 1) + ", " + core::fixed_text(p.y(), 1) + ", " +
         core::fixed_text(p.z(), 1) + ")";
}

/// The connected part that is nearest to a place.
geometry::TriMesh part_at(const geometry::TriMesh& mesh, const Vec3& place) {
  const std::vector<std::int32_t> part = geometry::components(mesh);
  if (std::ranges::all_of(part, [](std::int32_t p) { return p == 0; })) return mesh;
  const std::int32_t wanted =
      part[static_cast<std::size_t>(geometry::AabbTree(mesh).closest(place).triangle)];
  std::vector<bool> keep(part.size());
  for (std::size_t t = 0; t < part.size(); ++t) keep[t] = part[t] == wanted;
  return geometry::subset(mesh, keep);
}

}  // namespace

std::vector<UnreachedPlace> unreached(const geometry::TriMesh& lumen, const Vec3& source,
                                      const std::vector<Vec3>& targets, double near_mm) {
  const geometry::AabbTree part(part_at(lumen, source));
  std::vector<UnreachedPlace> missing;
  for (const Vec3& target : targets) {
    const geometry::SurfacePoint nearest = part.closest(target);
    if (nearest.distance > near_mm && !part.inside(target))
      missing.push_back({target, nearest.point, nearest.distance});
  }
  return missing;
}

std::vector<UnreachedPlace> unreached(const geometry::VesselTree& axes, const std::vector<Vec3>& targets) {
  std::vector<UnreachedPlace> missing;
  for (const Vec3& target : targets) {
    UnreachedPlace nearest{target, target, std::numeric_limits<double>::infinity()};
    double beyond = nearest.missing_mm;  // what is near enough
    for (const geometry::Vessel& vessel : axes.vessels) {
      const geometry::Centerline& last = geometry::segment(axes, vessel.segments.back()).axis;
      const double away = (last.points.back() - target).norm();
      beyond = std::min(beyond, away - near_in_radii * last.radius.back() - near_besides_mm);
      if (away < nearest.missing_mm) nearest = {target, last.points.back(), away};
    }
    if (beyond > 0.0) missing.push_back(nearest);
  }
  return missing;
}

std::string text_of(const UnreachedPlace& place) {
  return "the lumen ends at " + point_text(place.reached) + " mm, " +
         core::significant_text(place.missing_mm, 3) + " mm before the target " + point_text(place.place) +
         "; place a seed between them, or end the vessel where the lumen ends";
}

std::vector<std::string> texts_of(const std::vector<UnreachedPlace>& places) {
  std::vector<std::string> texts;
  for (const UnreachedPlace& place : places) texts.push_back(text_of(place));
  return texts;
}

}  // namespace ostia::pipeline
