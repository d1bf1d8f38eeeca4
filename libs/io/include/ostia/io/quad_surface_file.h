#pragma once
/// \file Surfaces of quadrilaterals: VTP, VTK, PLY, OBJ and STL out. World LPS, mm.

#include "ostia/core/task_context.h"
#include "ostia/geometry/mixed_mesh.h"

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

namespace ostia::io {

/// Readers that split a quadrilateral do so from its first corner: to its third.
struct QuadSurface {
  std::vector<geometry::Vec3> points;
  std::vector<geometry::Quad> quads;     ///< counter-clockwise seen from outside
  std::vector<std::int32_t> branch_ids;  ///< one a quadrilateral, or empty
  std::vector<std::int32_t> face_ids;    ///< one a quadrilateral, or empty
  std::vector<geometry::Face> faces;     ///< names of the face ids
};

/// Of a surface whose triangles 2q and 2q + 1 are the halves of quadrilateral q, each of which begins with
/// such a corner that readers split it in the same way. `branch_ids`: one a quadrilateral, or empty.
QuadSurface quads_of_pairs(const geometry::FacedSurface& halves, std::vector<geometry::Vec3> points,
                           std::vector<std::int32_t> branch_ids);

/// Writes by extension, whole or not at all, and tells what the format could not hold.
/// - .vtp, .vtk (legacy, binary): double precision, arrays of the cells `CellEntityIds` (the face) and
///   `BranchIds`, names of the faces.
/// - .ply: binary, double precision, properties `branch` and `face` of each face; the names are comments.
/// - .obj: the shortest digits that read back to the same bits, groups `<face> branch_<n>`.
/// - .stl: binary, single precision, two triangles a quadrilateral.
/// Throws InvalidInput for another extension, for a quadrilateral that names a point which is not there and
/// for ids that are not one a quadrilateral; IoError; ResourceError on a full disk; Cancelled.
std::vector<std::string> write_quad_surface(const std::filesystem::path& path, const QuadSurface& surface,
                                            const core::TaskContext& task = core::no_task());

}  // namespace ostia::io
