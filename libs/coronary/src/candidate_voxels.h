#pragma once
/// \file Voxels that may belong to a coronary artery, by their intensity.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::coronary {

/// Voxels of at least `level_hu` that have something darker within `inner_mm` along at least two of the six
/// directions of the grid: the rim of chambers and the aorta, and vessels.
imaging::MaskVolume vessel_candidates(const imaging::ImageVolume& image, double level_hu, double inner_mm,
                                      const core::TaskContext& task);

}  // namespace ostia::coronary
