#pragma once
/// \file The readers behind volume_mesh_file.h.

#include "ostia/geometry/mixed_mesh.h"

#include <filesystem>

namespace ostia::io {

geometry::MixedMesh read_vtu(const std::filesystem::path& path);
geometry::MixedMesh read_gmsh(const std::filesystem::path& path);

}  // namespace ostia::io
