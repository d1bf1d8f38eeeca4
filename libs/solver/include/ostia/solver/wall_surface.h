#pragma once
/// \file The wall of a volume mesh as a surface, and values carried between facets, elements and points.

#include "ostia/geometry/mixed_mesh.h"

#include <cstdint>
#include <string>
#include <vector>

namespace ostia::solver {

using geometry::Vec3;

/// The wall's facets face by face, of each its triangles and then its quadrilaterals: the order of OpenFOAM's
/// patches.
struct WallSurface {
  geometry::FacedSurface surface;         ///< with points of its own; a quadrilateral is two triangles
  std::vector<std::int32_t> mesh_points;  ///< of each of its points that of the mesh
  std::vector<std::int32_t> facet_of;     ///< of each of its triangles
  std::vector<double> areas_mm2;          ///< of each facet
  struct Part {
    std::string name;  ///< as exports write it
    std::size_t first = 0, count = 0;
  };
  std::vector<Part> parts;  ///< the facets of each face that is a wall
};
/// Throws InvalidInput where no facet belongs to a wall.
WallSurface wall_surface(const geometry::MixedMesh& mesh);

/// Values of facets at the surface's points, weighted with the areas of the triangles about each.
/// `components` together.
std::vector<double> at_wall_points(const WallSurface& wall, const std::vector<double>& facets,
                                   std::size_t components);

/// Of each element, tetrahedra first, mm3.
std::vector<double> element_volumes(const geometry::MixedMesh& mesh);

/// Values of elements at the mesh's points, weighted with the volumes of the elements about each.
/// `components` together; a point of no element gets 0.
std::vector<double> at_mesh_points(const geometry::MixedMesh& mesh, const std::vector<double>& elements,
                                   std::size_t components);

}  // namespace ostia::solver
