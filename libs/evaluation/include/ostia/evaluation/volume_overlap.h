#pragma once
/// \file Overlap of masks, of labels, and of what closed surfaces enclose.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

namespace ostia::evaluation {

struct VolumeOverlap {
  double reference_mm3 = 0.0, result_mm3 = 0.0, both_mm3 = 0.0;
  double dice = 0.0, jaccard = 0.0;
  double relative_difference = 0.0;  ///< (result - reference) / reference
};

/// Nonzero voxels. Throws InvalidInput when the grids differ or both masks are empty.
VolumeOverlap compare_masks(const imaging::MaskVolume& reference, const imaging::MaskVolume& result);

/// What two closed outward surfaces enclose, along parallel lines that stand `resolution_mm` apart, tilted
/// against all axes: exact along them. For tubes the error is a few per mille of the volume at an eighth of
/// the radius (docs/methods/evaluate-surface.md). Only places where `counts` (all when empty; asked every
/// half resolution along a line). Throws InvalidInput for surfaces without triangles or with open edges, and
/// where neither encloses anything.
VolumeOverlap compare_enclosed(const geometry::TriMesh& reference, const geometry::TriMesh& result,
                               double resolution_mm = 0.2, const Region& counts = {},
                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
