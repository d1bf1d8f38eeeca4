#include "intake/specks.h"

#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <algorithm>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;

constexpr double speck_area_share = 0.01, speck_extent_share = 0.06;
constexpr std::size_t fewest_triangles = 12;  // of a vessel, however long they are

/// Whether a part lies within a larger one.
bool is_bubble(const TriMesh& part, const std::vector<TriMesh>& parts, std::size_t own) {
  for (std::size_t i = 0; i < parts.size(); ++i) {
    if (i == own || geometry::area(parts[i]) <= geometry::area(part)) continue;
    if (!geometry::bounds(parts[i].points).contains(geometry::bounds(part.points))) continue;
    const geometry::Vec3& some = part.points[static_cast<std::size_t>(part.triangles[0][0])];
    if (geometry::AabbTree(parts[i]).inside(some)) return true;
  }
  return false;
}

}  // namespace

std::string Specks::text() const {
  return std::to_string(specks) + " loose specks and " + std::to_string(bubbles) +
         " closed parts within the lumen left out, the largest " + core::fixed_text(longest_mm, 2) +
         " mm long at (" + core::fixed_text(where.x(), 1) + ", " + core::fixed_text(where.y(), 1) + ", " +
         core::fixed_text(where.z(), 1) + ") mm";
}

Specks drop_specks(std::vector<TriMesh>& parts) {
  Specks gone;
  if (parts.size() < 2) return gone;
  double area = 0.0, extent = 0.0;
  const auto extent_of = [](const TriMesh& part) { return geometry::bounds(part.points).sizes().norm(); };
  for (const TriMesh& part : parts) {
    area = std::max(area, geometry::area(part));
    extent = std::max(extent, extent_of(part));
  }
  std::vector<TriMesh> kept;
  for (std::size_t i = 0; i < parts.size(); ++i) {
    const double length = extent_of(parts[i]);
    const bool speck = geometry::area(parts[i]) < speck_area_share * area &&
                       (length < speck_extent_share * extent || parts[i].triangles.size() < fewest_triangles);
    if (!speck && !is_bubble(parts[i], parts, i)) {
      kept.push_back(parts[i]);
      continue;
    }
    ++(speck ? gone.specks : gone.bubbles);
    if (length <= gone.longest_mm) continue;
    gone.longest_mm = length;
    gone.where = geometry::bounds(parts[i].points).center();
  }
  parts = std::move(kept);
  return gone;
}

TriMesh joined(const std::vector<TriMesh>& parts) {
  TriMesh all;
  for (const TriMesh& part : parts) all = all.triangles.empty() ? part : geometry::merged(all, part);
  return all;
}

}  // namespace ostia::pipeline
