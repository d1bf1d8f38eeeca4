#pragma once
/// \file Where a way of the front has come from an artery into a vein beside it.

#include "tube_front.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

/// How a vein is told from an artery.
struct VeinLook {
  const imaging::ImageVolume& image;
  double fat_hu = -90.0, contrast_hu = 490.0;  ///< of the aorta above fat
};

/// Of a way whose end comes first: how many voxels, from its end on, lie in a vein. That is a stretch of 15
/// mm or more that is as wide as an artery of full contrast would be and yet fainter. 0 where there is none.
std::size_t voxels_in_vein(const VeinLook& look, const FrontNodes& nodes, const imaging::FloatVolume& tube,
                           const imaging::FloatVolume& radius_mm, const std::vector<std::int64_t>& way);

}  // namespace ostia::coronary
