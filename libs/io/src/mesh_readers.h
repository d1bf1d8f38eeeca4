#pragma once
/// \file The readers behind volume_mesh_file.h.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>

namespace ostia::io {

geometry::MixedMesh read_vtu(const std::filesystem::path& path);
geometry::MixedMesh read_gmsh(const std::filesystem::path& path);
geometry::MixedMesh read_exodus(const std::filesystem::path& path);
geometry::MixedMesh read_fluent(const std::filesystem::path& path);
geometry::MixedMesh read_abaqus(const std::filesystem::path& path);
geometry::MixedMesh read_cgns(const std::filesystem::path& path);
/// A file, or a folder with mesh.xdmf.
geometry::MixedMesh read_xdmf(const std::filesystem::path& path);
/// A case, its `constant` or its `polyMesh`.
geometry::MixedMesh read_openfoam(const std::filesystem::path& path);
/// The folder with `faces` and `owner` that `path` is or has; empty where it has none.
std::filesystem::path poly_mesh_in(const std::filesystem::path& path);

}  // namespace ostia::io
