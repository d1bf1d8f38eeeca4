#pragma once
/// \file Surfaces: STL, PLY, OBJ, VTP and legacy VTK in; STL, PLY and VTP out. World LPS, mm.

#include "ostia/core/error.h"
#include "ostia/geometry/tri_mesh.h"

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// A surface as its file has it: faults are kept, for geometry::find_faults to count.
struct LoadedSurface {
  geometry::FacedSurface surface;     ///< face_ids and faces are empty where the file has none
  std::vector<std::string> warnings;  ///< "12 quadrilaterals split into triangles"
};

/// A sound file without a triangle: where several are read, one of them may hold nothing.
class EmptySurface : public InvalidInput {
 public:
  using InvalidInput::InvalidInput;
};

/// True for an extension that `read_surface` knows; of .vtk, for a file that holds polygons or strips (one of
/// lines is a tree: is_graph_file).
bool is_surface_file(const std::filesystem::path& path);

/// Reads by extension and content. Points of an STL that are equal bit for bit are one point. Checked before
/// anything is allocated by it: triangle counts against the file's size, indices against the number of
/// points, XML for entities. Throws InvalidInput naming the file and the field (EmptySurface where there is
/// no triangle), IoError when it cannot be read.
LoadedSurface read_surface(const std::filesystem::path& path);

/// Writes by extension, whole or not at all. STL: binary, single precision. VTP: `CellEntityIds` and the
/// faces' names. PLY: double precision. A format that cannot hold face ids drops them only for a surface of a
/// single face, else throws InvalidInput.
void write_surface(const std::filesystem::path& path, const geometry::TriMesh& mesh);
void write_surface(const std::filesystem::path& path, const geometry::FacedSurface& surface);

}  // namespace ostia::io
