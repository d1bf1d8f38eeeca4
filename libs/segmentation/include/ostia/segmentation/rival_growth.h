#pragma once
/// \file Vessels that touch others, taken apart by where they come from.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/seeds.h"

#include <vector>

namespace ostia::segmentation {

struct RivalGrowthOptions {
  double least_hu = 100.0;  ///< voxels that are not brighter belong to nobody
  double snap_mm = 1.5;     ///< a place means the brightest voxel within this, [0, 10]
};
void validate(const RivalGrowthOptions& options);  ///< throws InvalidInput

/// The masks' values.
enum class Owner : std::uint8_t { nobody = 0, seeds = 1, rivals = 2 };

/// Who owns each voxel: of the ways along bright voxels (through faces) from the seeds and from the rivals,
/// the one whose dimmest voxel is brightest wins, and takes what is reached through it: relative fuzzy
/// connectedness (J. K. Udupa, P. K. Saha and R. A. Lotufo, IEEE Trans. Pattern Anal. Mach. Intell.
/// 24:1485-1500, 2002), as an image foresting transform, so that each voxel has one owner and all of an
/// owner's voxels are linked with its places (A. X. Falcao et al., IEEE Trans. Pattern Anal. Mach. Intell.
/// 26:19-29, 2004). Where artery and vein touch, partial volume leaves a dimmer voxel between. Of equally
/// good ways the one found first counts; seeds go before rivals. Throws InvalidInput for options, an empty
/// image, no seed, a place outside the image or not near a bright voxel, a seed and a rival in one voxel;
/// Cancelled.
imaging::MaskVolume grown_against(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds,
                                  const std::vector<Vec3>& rivals, const RivalGrowthOptions& options = {},
                                  const core::TaskContext& task = core::no_task());

}  // namespace ostia::segmentation
