#pragma once
/// \file A level set as the images and the surface that the steps after it take.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

namespace ostia::experiments {

/// 1,000 inside and 0 outside of the surface, with a ramp of the longest side of a voxel across it: what a
/// mask rounds away is seen.
imaging::FloatVolume share_inside(const imaging::FloatVolume& level_set);
/// 1 where the level set is negative.
imaging::MaskVolume mask_inside(const imaging::FloatVolume& level_set);

/// The zero level set, closed at the image's border.
geometry::TriMesh isosurface_of(const imaging::FloatVolume& level_set,
                                const core::TaskContext& task = core::no_task());

}  // namespace ostia::experiments
