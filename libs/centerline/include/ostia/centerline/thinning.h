#pragma once
/// \file The skeleton of a binary image by homotopic thinning.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <vector>

namespace ostia::centerline {

/// docs/methods/skeleton.md gives the method.
struct ThinningOptions {
  /// Voxels with one neighbour stay. Without, components shrink to points and loops.
  bool keep_ends = true;
  /// Cavities (background that does not reach the border, faces apart) count as object. With them, the
  /// skeleton holds a closed surface about each.
  bool fill_cavities = false;
};

/// A skeleton: the voxels that are left, 1 in the mask, and how deep they lie.
struct Thinned {
  imaging::MaskVolume mask;               ///< the input's grid
  std::vector<std::int64_t> voxels;       ///< offsets of the skeleton's voxels, ascending
  std::vector<float> distance_mm;         ///< one a voxel: to the centre of the nearest background voxel
  std::int64_t object_voxels = 0;         ///< of the input
  std::int64_t filled_cavity_voxels = 0;  ///< taken for object
};

/// The skeleton of the voxels that are not 0, 26-connected in a 6-connected background; outside the image is
/// background. Simple points (both topological numbers 1: G. Bertrand and G. Malandain, Pattern Recognit.
/// Lett. 15:169-175, 1994) that are no end points (one 26-neighbour at most) are removed in the order of
/// their Euclidean distance to the background, in mm ([Luboz] 2.1), from six sides in turn at each distance,
/// voxels of eight classes that do not touch one after another. So components, loops and cavities stay. A
/// component that would end as a pair of voxels becomes one voxel. The same for any number of threads. Throws
/// InvalidInput for an empty image or one whose geometry does not fit its voxels, ResourceError where the
/// object's box has 2^32 voxels or more, Cancelled.
Thinned thinned(const imaging::MaskVolume& mask, const ThinningOptions& options = {},
                const core::TaskContext& task = core::no_task());

}  // namespace ostia::centerline
