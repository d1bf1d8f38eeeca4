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
  /// Between walls of vessels that are far from each other along the tree, [0, 2]; below 0.12 mm they would
  /// grow together in the model.
  double apart_mm = 0.3;
};
void validate(const MaskWallOptions& options);  ///< throws InvalidInput

/// A part of the mask that lies outside all walls: a stub that was left out, the end of a vessel that was
/// shortened, what lies between two vessels that were parted.
struct MaskOutside {
  geometry::Vec3 place = geometry::Vec3::Zero();  ///< farthest from the walls, mm
  double volume_mm3 = 0.0, length_mm = 0.0;       ///< the diagonal of its box
};

struct MaskWalls {
  std::vector<lumen::RadialWall> walls;  ///< one a vessel, in the tree's order
  std::vector<MaskOutside> outside;      ///< the largest first
};

/// Each voxel belongs to the vessel whose wall is nearest; a section's area is the volume of its vessel's
/// voxels over the length they are on, evened along the vessel, so that nothing shrinks; its shape is that of
/// rays to the blurred mask's edge. Where branches leave, a parent's area is that of its rays; in a gap it is
/// that of both ends. At a take-off a branch is a tube as wide as it is behind it. Walls are parted where
/// vessels touch that are far apart along the tree, and scaled by one factor so that together they hold the
/// mask's volume. Deterministic, the same for any number of threads. Throws InvalidInput for an empty
/// mask or tree, Cancelled.
MaskWalls walls_from_mask(const geometry::VesselTree& tree, const imaging::MaskVolume& lumen,
                          const MaskWallOptions& options = {},
                          const core::TaskContext& task = core::no_task());

}  // namespace ostia::pipeline
