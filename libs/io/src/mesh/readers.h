#pragma once
/// \file The readers behind volume_mesh_file.h.

#include "ostia/io/volume_mesh_file.h"

#include <filesystem>

namespace ostia::io {

LayeredMesh read_vtu(const std::filesystem::path& path);
LayeredMesh read_gmsh(const std::filesystem::path& path);
LayeredMesh read_exodus(const std::filesystem::path& path);
LayeredMesh read_fluent(const std::filesystem::path& path);
LayeredMesh read_abaqus(const std::filesystem::path& path);
LayeredMesh read_cgns(const std::filesystem::path& path);
/// A file, or a folder with mesh.xdmf.
LayeredMesh read_xdmf(const std::filesystem::path& path);
/// A case, its `constant` or its `polyMesh`.
LayeredMesh read_openfoam(const std::filesystem::path& path);
/// The folder with `faces` and `owner` that `path` is or has; empty where it has none.
std::filesystem::path poly_mesh_in(const std::filesystem::path& path);

}  // namespace ostia::io
