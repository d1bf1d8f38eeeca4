#pragma once
/// \file The wall that boundary layers grow on.

#include "ostia/geometry/tri_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::meshing {

struct WallRing {
  std::vector<std::int32_t> loop;  ///< wall points in the order of the wall's winding
  geometry::Face cap;
  geometry::Vec3 normal;  ///< of the cap's plane, unit, outward
};

struct LayerWall {
  geometry::TriMesh mesh;  ///< the wall alone, points in the surface's order
  std::vector<std::int32_t> face_ids;
  std::vector<std::vector<std::int32_t>> neighbours, triangles_of;
  std::vector<WallRing> rings;
  std::vector<std::int32_t> ring_of;  ///< of each point; -1 away from the caps
  std::vector<double> local_edge_mm;  ///< mean edge at a point, averaged twice over its neighbours

  const geometry::Vec3& point(std::int32_t v) const { return mesh.points[static_cast<std::size_t>(v)]; }
  /// `direction` within the cap's plane for points on a ring, of unit length.
  geometry::Vec3 admissible(std::int32_t v, const geometry::Vec3& direction) const;
};

/// "(1.00, 2.00, 3.00) mm", for messages.
std::string place_text(const geometry::Vec3& p);

/// Checks the surface and takes its wall. `numbers`: receives the wall's number of each of the surface's
/// points, -1 for those within caps. Throws InvalidInput and GeometryError as boundary_layer does.
LayerWall layer_wall(const geometry::FacedSurface& surface, std::vector<std::int32_t>* numbers = nullptr);

}  // namespace ostia::meshing
