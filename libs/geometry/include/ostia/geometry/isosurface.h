#pragma once
/// \file The zero set of a function given on a grid.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <array>
#include <cstdint>
#include <functional>
#include <vector>

namespace ostia::geometry {

/// A scalar grid, x fastest, and its map to the world: world = origin + axes * (i, j, k).
struct ScalarGrid {
  std::array<std::int64_t, 3> size{0, 0, 0};
  const float* values = nullptr;  ///< size[0]*size[1]*size[2], not owned
  Vec3 origin = Vec3::Zero();
  Mat3 axes = Mat3::Identity();  ///< columns: step to the next voxel, mm; may be left-handed
};

/// Surface where the values cross `level`, outward towards larger values (value < level is inside). Marching
/// cubes with a table that is consistent across faces (docs/methods/isosurface.md): the surface is a
/// 2-manifold, oriented whatever the handedness of the axes, and open in the faces of the grid only. Points
/// are shared, and kept 1e-3 of a step off the voxels so that no triangle is degenerate. With
/// `closed_at_border` all beyond the grid is outside and the result is closed there too, half a step beyond
/// the border's voxels. Infinite values are allowed. The same for any number of threads. Throws InvalidInput
/// for NaN, flat axes or an empty grid.
TriMesh isosurface(const ScalarGrid& grid, float level, bool closed_at_border,
                   const core::TaskContext& task = core::no_task());

/// The zero set of a function in a box, sampled at `spacing_mm` (for implicit models); open where it leaves
/// the box. `f` is called from several threads at once.
TriMesh isosurface(const std::function<double(const Vec3&)>& f, const Box3& box, double spacing_mm,
                   const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
