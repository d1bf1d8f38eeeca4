#pragma once
/// \file The initial region of all branches, evolved as one surface.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/level_set.h"
#include "ostia/segmentation/segment.h"

#include <cstdint>
#include <vector>

namespace ostia::segmentation::detail {

/// Voxels next to the surface, on either side, and those inside that are not.
struct Shell {
  std::vector<std::int64_t> surface;
  std::vector<std::int64_t> interior;
};
Shell shell_of(const imaging::FloatVolume& level_set);

struct EvolvedRegion {
  LevelSetResult surface;
  double balloon_mean_hu = 0.0, balloon_sigma_hu = 0.0;  ///< what was used; 0 without a balloon
};

/// `initial` (on `region` of the image, with its shell) evolved on the feature and with the weights that are
/// wanted. `lumen_hu`: what counts as lumen at most, where brighter things do.
EvolvedRegion evolve_region(const imaging::ImageVolume& image, const imaging::Region& region,
                            const imaging::FloatVolume& initial, const Shell& shell,
                            const SegmentOptions& wanted, double lumen_hu, const core::TaskContext& task);

}  // namespace ostia::segmentation::detail
