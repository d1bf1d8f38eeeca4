#pragma once
/// \file What is known on a surface, at points and on triangles, such as the shear stress on a wall, in a VTP
/// file.

#include "ostia/geometry/tri_mesh.h"
#include "ostia/io/volume_fields.h"

#include <filesystem>
#include <map>
#include <string>

namespace ostia::io {

/// Fields by name at the points of a surface.
using PointFields = std::map<std::string, FieldValues>;

/// Writes what write_surface writes as VTP, with the fields as point data. Throws InvalidInput where a field
/// has another number of values, IoError.
void write_vtp_with_fields(const std::filesystem::path& path, const geometry::FacedSurface& surface,
                           const PointFields& fields);

struct SurfaceWithFields {
  geometry::TriMesh mesh;
  PointFields points;                            ///< as `mesh.points`
  std::map<std::string, FieldValues> triangles;  ///< as `mesh.triangles`
};

/// Reads a VTP file (or a legacy .vtk). A polygon's values go to each triangle that it is split into. Arrays
/// that are no numbers, and ids of faces, are left out. Throws InvalidInput as read_surface does, and for
/// another kind of file; IoError.
SurfaceWithFields read_surface_with_fields(const std::filesystem::path& path);

}  // namespace ostia::io
