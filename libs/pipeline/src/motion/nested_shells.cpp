#include "motion/nested_shells.h"

#include "intake/intake_ends.h"
#include "intake/intake_units.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"
#include "ostia/pipeline/lumen_surface.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace ostia::pipeline {
namespace {

using geometry::TriMesh;
using geometry::Vec3;

// A lumen is so long and has so much area, over those of the wall's outside; a bubble or a device is less.
constexpr double least_length_share = 0.7, least_area_share = 0.3;
constexpr std::size_t samples = 60;
constexpr double most_inside = 0.9;  // open ends may stand out

double length_of(const TriMesh& part) {
  return geometry::bounds(part.points).sizes().norm();
}

double width_of(const TriMesh& part) {
  return calibre_of_closed(geometry::fill_holes(part).mesh);
}

bool is_lumen_of(const TriMesh& inner, const TriMesh& outer) {
  if (length_of(inner) < least_length_share * length_of(outer) || length_of(inner) > 1.1 * length_of(outer) ||
      geometry::area(inner) < least_area_share * geometry::area(outer) ||
      geometry::area(inner) >= geometry::area(outer))
    return false;
  const geometry::AabbTree tree(geometry::fill_holes(outer).mesh);
  const std::size_t step = std::max<std::size_t>(1, inner.triangles.size() / samples);
  std::size_t inside = 0, asked = 0;
  for (std::size_t i = 0; i < inner.triangles.size(); i += step, ++asked) {
    Vec3 middle = Vec3::Zero();
    for (const std::int32_t v : inner.triangles[i]) middle += inner.points[static_cast<std::size_t>(v)] / 3.0;
    inside += tree.inside(middle);
  }
  return static_cast<double>(inside) >= most_inside * static_cast<double>(asked);
}

std::string outer_wall_text(const TriMesh& inner, const TriMesh& outer) {
  return "two shells one within the other: the inner, " + core::fixed_text(width_of(inner), 2) +
         " mm wide in the mean, is taken as the lumen, the outer, " + core::fixed_text(width_of(outer), 2) +
         " mm wide and " + core::fixed_text(length_of(outer), 1) + " mm long about " +
         place_text(geometry::bounds(outer.points).center()) +
         ", as the outside of its wall and left out; a file with the outer alone meshes that";
}

}  // namespace

std::string LumenInWall::text(double unit_mm) const {
  return "a lumen and the outside of its wall, joined by " + std::to_string(ends.size()) +
         " flat rings at the ends: the inside, " + core::fixed_text(unit_mm * width, 2) +
         " mm wide in the mean, is taken as the lumen; the outside, " +
         core::fixed_text(unit_mm * outside_width, 2) + " mm wide, and the rings are left out";
}

std::optional<LumenInWall> lumen_in_wall(const geometry::FacedSurface& surface) try {
  geometry::FacedSurface shell{geometry::oriented(geometry::welded(surface.mesh)), {}, surface.faces};
  const geometry::SurfaceFaults faults = geometry::find_faults(shell.mesh, false);
  if (!faults.closed_manifold() || faults.components != 1 || handles_of(shell.mesh) == 0) return std::nullopt;
  if (shell.mesh.triangles.size() == surface.face_ids.size()) shell.face_ids = surface.face_ids;
  meshing::OpenedRings opened = meshing::without_flat_rings(shell);
  if (opened.ends.size() < 2) return std::nullopt;
  std::vector<TriMesh> parts = parts_of(opened.walls);
  if (parts.size() != 2) return std::nullopt;
  for (TriMesh& part : parts) part = turned_outward(std::move(part));
  if (geometry::area(parts[0]) > geometry::area(parts[1])) std::swap(parts[0], parts[1]);
  if (!is_lumen_of(parts[0], parts[1])) return std::nullopt;
  LumenInWall found;
  found.width = width_of(parts[0]);
  found.outside_width = width_of(parts[1]);
  found.lumen = std::move(parts[0]);
  found.ends = std::move(opened.ends);
  return found;
} catch (const Error&) {
  return std::nullopt;  // too broken to be one
}

std::vector<std::string> drop_outer_walls(std::vector<TriMesh>& parts) {
  std::vector<std::string> told;
  for (std::size_t outer = 0; outer < parts.size();) {
    const auto inner = std::ranges::find_if(parts, [&](const TriMesh& part) {
      return &part != &parts[outer] && is_lumen_of(part, parts[outer]);
    });
    if (inner == parts.end()) {
      ++outer;
      continue;
    }
    told.push_back(outer_wall_text(*inner, parts[outer]));
    parts.erase(parts.begin() + static_cast<std::ptrdiff_t>(outer));
  }
  return told;
}

}  // namespace ostia::pipeline
