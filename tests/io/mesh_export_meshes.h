#pragma once
/// \file Small volume meshes whose measures are known, for the tests of mesh export.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>
#include <map>
#include <string>

namespace ostia::io {

/// A hexagonal column along +z, 8 mm long in four slices: a core of tetrahedra of 2 mm (its corners' distance
/// from the axis) and round it a ring of prisms up to 3 mm, their triangles towards core and wall. Faces,
/// their ids not in a row: 1 `wall`, 4 `inlet_rca` (z = 0), 7 `outlet_rca` (z = 8), caps of triangles and
/// quadrilaterals.
geometry::MixedMesh column_with_prisms();
/// The core alone, of 2 mm.
geometry::MixedMesh column_of_tetrahedra();
/// The ring alone, whose inside is a fourth face: 21 `outlet_core`.
geometry::MixedMesh ring_of_prisms();
/// The same with the nodes of the second order, moved off the middles by a smooth bend, so that every edge
/// and side is curved and an order that is not kept shows in the volume.
geometry::MixedMesh quadratic(const geometry::MixedMesh& linear);

inline constexpr double column_length = 8.0, core_radius = 2.0, column_radius = 3.0;

struct FaceMeasure {
  std::int32_t id = 0;
  std::size_t triangles = 0, quads = 0;
  double area = 0.0;                          ///< mm2
  geometry::Vec3 vector_area{0.0, 0.0, 0.0};  ///< mm2, along the outward normal
};
/// What a reader must find again.
struct MeshMeasure {
  std::size_t tetrahedra = 0, prisms = 0;
  double volume = 0.0;             ///< mm3
  double smallest_jacobian = 0.0;  ///< of a reader: not positive where nodes are out of order
  std::map<std::string, FaceMeasure> faces;
};

/// The volume by the divergence theorem over the boundary, which knows nothing of the elements' nodes.
MeshMeasure measure(const geometry::MixedMesh& mesh);

/// What tests/io/readers writes.
MeshMeasure read_measure(const std::filesystem::path& file);

}  // namespace ostia::io
