#pragma once
/// \file Adds a cap to a surface.

#include "cutting/plane_triangulation.h"

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <vector>

namespace ostia::meshing {

/// Fills a border loop (in the order of the wall's winding) with flat triangles of `face`, outward. The face
/// is not added to `faces`. `good_angle_deg`: as triangulate_flat has it.
inline void fill_cap(geometry::FacedSurface& surface, const std::vector<std::int32_t>& loop,
                     double edge_factor, const geometry::Face& face, double good_angle_deg = 0.0) {
  const std::vector<std::int32_t> reversed(loop.rbegin(), loop.rend());
  const std::vector<geometry::Vec3> points = loop_points(surface.mesh, reversed);
  const FlatPatch patch =
      triangulate_flat(points, edge_factor * mean_edge(points), face.name, good_angle_deg);
  const auto first_inner = static_cast<std::int32_t>(surface.mesh.points.size());
  const auto on_loop = static_cast<std::int32_t>(loop.size());
  surface.mesh.points.insert(surface.mesh.points.end(), patch.inner_points.begin(), patch.inner_points.end());
  for (geometry::Triangle t : patch.triangles) {
    for (std::int32_t& v : t)
      v = v < on_loop ? reversed[static_cast<std::size_t>(v)] : first_inner + v - on_loop;
    surface.mesh.triangles.push_back(t);
    surface.face_ids.push_back(face.id);
  }
}

}  // namespace ostia::meshing
