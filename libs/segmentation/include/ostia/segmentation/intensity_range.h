#pragma once
/// \file Which intensities are lumen.

#include "ostia/geometry/vec.h"
#include "ostia/imaging/volume.h"

#include <vector>

namespace ostia::segmentation {

using geometry::Vec3;

/// Intensities that count as lumen, HU, both included.
struct IntensityRange {
  double lower = 0.0;
  double upper = 0.0;
};

/// The range that is taken when none is given. The lumen's intensity is the least of the medians of seven
/// voxels at each seed, the background's the median of the darker class (Otsu's split) of what is neither air
/// nor fat nor lumen in the neighbourhood of the seeds; the lower bound lies half-way. The upper bound lies
/// as far above the brightest seed as the background lies below the darkest. Throws InvalidInput for a seed
/// outside the image or in air, and where one has less than a third of another's contrast.
IntensityRange intensity_range_around(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm);

}  // namespace ostia::segmentation
