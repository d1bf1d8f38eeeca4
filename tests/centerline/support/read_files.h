#pragma once
/// \file Just enough reading of the real inputs' formats for the tests of this room.

#include "ostia/geometry/centerline.h"
#include "ostia/geometry/tri_mesh.h"

#include <filesystem>
#include <vector>

namespace ostia::testing {

/// Binary or ASCII STL; equal corners are joined.
geometry::TriMesh read_stl(const std::filesystem::path& path);

/// Points and their `Radius` of a VTP file whose arrays are appended, base64 and zlib-compressed, little
/// endian.
geometry::Centerline read_compressed_vtp_points(const std::filesystem::path& path);

/// Points of a legacy VTK ASCII file.
std::vector<geometry::Vec3> read_ascii_vtk_points(const std::filesystem::path& path);

}  // namespace ostia::testing
