#pragma once
/// \file Which intensities are lumen, from the image about the seeds: what the room needs of it
/// (intensity_range.cpp).

#include "fronts/fast_marching.h"

#include "ostia/imaging/volume.h"
#include "ostia/segmentation/intensity_range.h"

#include <optional>
#include <string>
#include <vector>

namespace ostia::segmentation::detail {

struct SeedIntensities {
  double darkest = 1e9;  ///< least of the seeds' medians
  double brightest = -1e9;
  Vec3 darkest_at = Vec3::Zero();
  Vec3 brightest_at = Vec3::Zero();
};

/// Median of a voxel and its six neighbours at each seed. Throws InvalidInput for a seed outside the image or
/// in air.
SeedIntensities seed_intensities(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm);

struct ChosenRange {
  IntensityRange range;
  double lumen_hu = 0.0;
  bool chosen = false;
};
/// The range given, completed from the image.
ChosenRange choose_range(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm,
                         const std::optional<double>& lower, const std::optional<double>& upper);

/// The voxel at a seed or, where that is outside the range, the nearest of its neighbours inside it. Throws
/// InvalidInput.
Voxel voxel_in_range(const imaging::ImageVolume& image, const Vec3& seed_mm, const IntensityRange& range);

/// The CT number of the tissue around the seeds: the median of the darker class (Otsu's split) of what is
/// neither air nor fat nor as bright as `lumen`.
double background_hu(const imaging::ImageVolume& image, const std::vector<Vec3>& seeds_mm, double lumen);

std::string text(const Vec3& point);  ///< "(1.0, 2.0, 3.0)"

}  // namespace ostia::segmentation::detail
