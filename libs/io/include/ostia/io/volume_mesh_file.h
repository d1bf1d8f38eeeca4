#pragma once
/// \file Tetrahedral meshes as VTU. World LPS, mm.

#include "ostia/geometry/tri_mesh.h"

#include <filesystem>

namespace ostia::io {

/// Tetrahedra and boundary triangles in one file, told apart by the cell array `CellEntityIds` (0 volume, 1
/// wall, 2 and up the caps); the faces' names in the field arrays `FaceIds`, `FaceNames`. Compressed, whole
/// or not at all.
void write_volume_mesh(const std::filesystem::path& path, const geometry::VolumeMesh& mesh);

/// Reads what `write_volume_mesh` writes, and any VTU of linear tetrahedra and triangles. Cells of other
/// types are refused by name; ids are checked. Without `CellEntityIds` all triangles are the wall.
geometry::VolumeMesh read_volume_mesh(const std::filesystem::path& path);

}  // namespace ostia::io
