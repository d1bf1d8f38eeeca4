#pragma once
/// \file Light that comes from all sides: what lies in a hollow of the heart is darker.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::view {

/// For each voxel of an image the share of light from all sides that reaches it, in [0, 1]: 1 less how much
/// of what is about it, within 3 and within 8 mm, is denser than water (full from 200 HU on). Does not depend
/// on the look. Throws Cancelled.
std::vector<float> ambient_light(const imaging::ImageVolume& image,
                                 const core::TaskContext& task = core::no_task());

}  // namespace ostia::view
