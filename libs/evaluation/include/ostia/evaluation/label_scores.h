#pragma once
/// \file Masks and label volumes against each other: overlap, and distances of the boundaries.

#include "ostia/core/task_context.h"
#include "ostia/evaluation/surface_distance.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/geometry/tri_mesh.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::evaluation {

/// The closed surface around the voxels of one label: marching cubes through the midpoints between voxels
/// inside and outside, closed half a voxel beyond the border of the image. Steps of voxels stay: a point may
/// be half a voxel's diagonal off the surface that was drawn. Empty where no voxel has the label.
geometry::TriMesh boundary_of(const imaging::ImageVolume& labels, std::int16_t label,
                              const core::TaskContext& task = core::no_task());

/// One label of a reference and a result.
struct LabelScore {
  int label = 0;
  bool in_reference = true, in_result = true;
  VolumeOverlap overlap;  ///< Dice 0 where only one has the label
  double difference_mm3 = 0.0;
  SurfaceDistances boundary;  ///< of the two boundaries; NaN where only one has the label
};

/// Every label (other than 0) that either has, ascending. The sample distance of `options` is kept; its
/// regions must be empty. Throws InvalidInput for other grids, for two volumes without a label, and for more
/// than 64 different values (an image of grey values, no labels).
std::vector<LabelScore> compare_labels(const imaging::ImageVolume& reference,
                                       const imaging::ImageVolume& result,
                                       const SurfaceDistanceOptions& options = {},
                                       const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
