#pragma once
/// \file A CT image of fewer voxels, for overviews and first looks.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <optional>

namespace ostia::imaging {

struct ReducedVolumeOptions {
  std::int64_t most_voxels = std::int64_t{160} * 160 * 160;  ///< [8, 1e9]
  /// Nothing farther out than the image's voxels that touch this box (LPS, mm) is kept: the heart about a
  /// tree, without the ribs.
  std::optional<geometry::Box3> box;
};
void validate(const ReducedVolumeOptions& options);  ///< throws InvalidInput

/// The image, or its part in the box, with no more than `most_voxels` voxels as near to cubes as that allows:
/// each is the mean over the volume that it covers, and together they cover the same field. An image that is
/// small enough comes back as it is. Throws InvalidInput for an empty image or a box that misses it, and
/// Cancelled. Meant for a background thread: 512 x 512 x 300 voxels take about 0.6 s.
ImageVolume reduced_volume(const ImageVolume& image, const ReducedVolumeOptions& options = {},
                           const core::TaskContext& task = core::no_task());

}  // namespace ostia::imaging
