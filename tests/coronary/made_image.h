#pragma once
/// \file Images of a function of the world, for tests.

#include "ostia/imaging/volume.h"

#include <algorithm>
#include <cmath>
#include <functional>

namespace ostia::testing {

/// Cubic voxels of `spacing_mm` over [-half, half] in x and y and [0, height] in z.
inline imaging::ImageVolume made_image(double half_mm, double height_mm, double spacing_mm,
                                       const std::function<double(const geometry::Vec3&)>& hu_at) {
  imaging::ImageVolume image;
  const auto across = static_cast<std::int64_t>(2.0 * half_mm / spacing_mm) + 1;
  image.geometry.size = {across, across, static_cast<std::int64_t>(height_mm / spacing_mm) + 1};
  image.geometry.spacing.setConstant(spacing_mm);
  image.geometry.origin = {-half_mm, -half_mm, 0.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i)
        image(i, j, k) = static_cast<std::int16_t>(std::lround(hu_at(image.geometry.world(
            geometry::Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))))));
  return image;
}

/// 1 inside, 0 outside, a ramp `width_mm` wide between them.
inline double ramp(double signed_distance_mm, double width_mm = 1.5) {
  return std::clamp(0.5 - signed_distance_mm / width_mm, 0.0, 1.0);
}

}  // namespace ostia::testing
