#pragma once
/// \file The axis of a vessel beside calcium, from the lumen's boundary there.

#include "ostia/coronary/axes.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/minimal_path.h"

namespace ostia::coronary {

/// Where a path says that calcium bounds the lumen, its points move to the middle of the boundary found about
/// them, twice (the second look starts within the lumen), with the boundary's radii. What lies within
/// `fixed_mm` of its start stays. Nothing where there is no calcium. Throws Cancelled.
void centre_beside_calcium(const imaging::ImageVolume& image, double fixed_mm, const AxesOptions& options,
                           segmentation::MinimalPath& path, const core::TaskContext& task);

}  // namespace ostia::coronary
