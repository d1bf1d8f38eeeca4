#pragma once
/// \file The walls of a tree's vessels as the mask that it was made of has them, without the voxels' stairs.

#include "ostia/core/task_context.h"
#include "ostia/geometry/vessel_tree.h"
#include "ostia/imaging/volume.h"
#include "ostia/lumen/start_surface.h"

#include <vector>

namespace ostia::pipeline {

/// docs/methods/mask-tree.md gives the method.
struct MaskWallOptions {
  double even_mm = 1.0;          ///< standard deviation along the vessel over which stairs are evened, [0, 5]
  double voxel_blur = 0.6;       ///< of the mask for the sections' shape, in its coarsest voxels, [0, 2]
  double least_radius_mm = 0.4;  ///< of a wall, [0.05, 2]
};
void validate(const MaskWallOptions& options);  ///< throws InvalidInput

/// One wall a vessel. Each voxel belongs to the vessel whose wall is nearest; a section's area is the volume
/// of its vessel's voxels over the length they are on, evened along the vessel, so that nothing shrinks; its
/// shape is that of rays to the blurred mask's edge. At a take-off a branch is a tube as wide as it is behind
/// it. All walls are then scaled by one factor so that together they hold the mask's volume. Deterministic,
/// the same for any number of threads. Throws InvalidInput for an empty mask or tree, Cancelled.
std::vector<lumen::RadialWall> walls_from_mask(const geometry::VesselTree& tree,
                                               const imaging::MaskVolume& lumen,
                                               const MaskWallOptions& options = {},
                                               const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
