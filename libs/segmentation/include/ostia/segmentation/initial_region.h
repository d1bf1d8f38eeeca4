#pragma once
/// \file What a level set starts from.

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/intensity_range.h"

#include <cstdint>
#include <vector>

namespace ostia::segmentation {

/// An initial level set on a part of the image's grid.
struct InitialRegion {
  imaging::FloatVolume level_set;  ///< negative inside, in [-1, 1]; on the cropped grid
  imaging::Region region;          ///< where that grid lies in the image
  IntensityRange range;            ///< intensities in which the fronts ran
  bool range_was_chosen = false;   ///< at least one bound came from the image
  double lumen_hu = 0.0;           ///< intensity about the seeds
  std::int64_t voxels = 0;         ///< inside
  std::int64_t visited = 0;        ///< voxels that fronts reached, all fronts together
  /// At each seed the direction along the vessel away from the other seed (unit, world); empty for plain fast
  /// marching.
  std::vector<Vec3> outward;
  /// Centres of the voxels of the fastest way between the seeds, each a face neighbour of the next (world);
  /// empty for plain fast marching.
  std::vector<Vec3> way;
  bool touches_border = false;  ///< the region reaches the border of the image: the vessel goes on outside
};

}  // namespace ostia::segmentation
