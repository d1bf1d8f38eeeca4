#pragma once
/// \file What is done to an image before vessels are looked for in it.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/segment.h"

#include <vector>

namespace ostia::segmentation::detail {

bool needs_preparation(const SegmentOptions& options);
/// The image without the tissues to be removed, then denoised: what is removed spreads nothing.
imaging::ImageVolume prepared_image(const imaging::ImageVolume& image,
                                    const std::vector<BranchSeeds>& branches, const SegmentOptions& options,
                                    const core::TaskContext& task);

}  // namespace ostia::segmentation::detail
