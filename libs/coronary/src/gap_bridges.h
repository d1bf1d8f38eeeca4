#pragma once
/// \file Where a vessel goes on behind a stretch that is too narrow to be seen.

#include "tube_front.h"

#include "ostia/coronary/tree_growth.h"
#include "ostia/segmentation/vesselness.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

/// What a front has seen.
struct GrownFront {
  const imaging::ImageVolume& image;
  const imaging::FloatVolume& tube;       ///< likeness to a tube as a share of the contrast; 0: not looked at
  const imaging::FloatVolume& radius_mm;  ///< of that tube
  const FrontNodes& reached;
  segmentation::VesselnessOptions tubes;  ///< how likeness was measured
  double fat_hu = -90.0, contrast_hu = 490.0;
  double least_tube = 0.25;
};

/// Across a gap: neighbouring voxels from the end of a branch to the vessel behind.
struct Bridge {
  std::vector<std::int64_t> voxels;  ///< offsets in the image's grid
  std::vector<float> radius_mm;      ///< of the tube, lumen or plaque, that each looks like
};

/// Looks ahead of a branch's end for what goes on in its direction at most `longest_mm` away, as wide and as
/// bright as the branch is, begins there and is joined to it by a tube, be it plaque alone. Empty where
/// nothing does. The branch is one of the front's ways. Throws Cancelled.
Bridge bridge_ahead(const GrownFront& front, const GrownBranch& branch, double longest_mm,
                    const core::TaskContext& task);

}  // namespace ostia::coronary
