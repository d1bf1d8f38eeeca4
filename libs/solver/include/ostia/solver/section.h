#pragma once
/// \file An open end of a mesh: what a velocity profile is given on.

#include "ostia/geometry/mixed_mesh.h"

#include <array>
#include <cstdint>
#include <vector>

namespace ostia::solver {

/// One face of a mesh. Facets are in the order in which io::export_mesh writes them: triangles in the mesh's
/// order, then quadrilaterals.
struct Section {
  std::vector<geometry::Vec3> points;               ///< those of the facets, mm
  std::vector<std::array<std::int32_t, 4>> facets;  ///< of `points`, outward; the fourth of a triangle is -1
  std::vector<geometry::Vec3> area_vectors_mm2;     ///< of each facet, outward
  std::vector<geometry::Vec3> centres;              ///< centroids of the facets, mm
  geometry::Vec3 normal = geometry::Vec3::UnitZ();  ///< of the whole, unit, outward
  double area_mm2 = 0.0;                            ///< along `normal`
  double diameter_mm() const;                       ///< of the circle of equal area
};

/// Throws InvalidInput when no facet has that face id, GeometryError when the facets' areas cancel (a closed
/// or folded face).
Section section_of(const geometry::MixedMesh& mesh, std::int32_t face_id);

}  // namespace ostia::solver
