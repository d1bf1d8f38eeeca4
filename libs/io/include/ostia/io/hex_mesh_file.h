#pragma once
/// \file Meshes of hexahedra for solvers. World LPS, mm.

#include "ostia/core/task_context.h"
#include "ostia/geometry/hex_mesh.h"

#include <filesystem>

namespace ostia::io {

/// Whole or not at all. `.vtu`: hexahedra and the boundary's quadrilaterals, told apart by CellEntityIds (0,
/// and the faces' ids), with the faces' names. Without an extension: an OpenFOAM case's folder,
/// constant/polyMesh in metres, a patch for each face; a folder that holds anything else is refused. Throws
/// InvalidInput (another extension; no hexahedra; a boundary that is not exactly their free sides, outward;
/// face ids without a face), IoError, ResourceError, Cancelled.
void write_hex_mesh(const std::filesystem::path& path, const geometry::HexMesh& mesh,
                    const core::TaskContext& task = core::no_task());

}  // namespace ostia::io
