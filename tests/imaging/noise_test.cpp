#include "ostia/imaging/noise.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace ostia::imaging {
namespace {

/// Tissue of 50 HU with blocks of `block_hu` in it, 12 mm wide and 24 mm apart, and noise on top.
ImageVolume noisy(double noise_hu, double block_hu = 50.0, double spacing_mm = 0.5) {
  ImageVolume image;
  image.geometry.size = {96, 96, 24};
  image.geometry.spacing = {spacing_mm, spacing_mm, 1.0};
  std::mt19937 generator(7);
  std::normal_distribution<double> noise(0.0, noise_hu);
  for (int k = 0; k < 24; ++k)
    for (int j = 0; j < 96; ++j)
      for (int i = 0; i < 96; ++i) {
        const bool block = i % 48 < 24 && j % 48 < 24;
        const double slope = 0.2 * i;  // a slow change is no noise
        image.voxels.push_back(
            static_cast<std::int16_t>(std::lround((block ? block_hu : 50.0) + slope + noise(generator))));
      }
  return image;
}

TEST(NoiseLevel, IsThatOfTheNoise) {
  for (const double hu : {8.0, 25.0, 90.0})
    EXPECT_NEAR(noise_level_hu(noisy(hu)).value(), hu, 0.1 * hu) << hu;
}

TEST(NoiseLevel, EdgesDoNotCount) {
  EXPECT_NEAR(noise_level_hu(noisy(25.0, 400.0)).value(), 25.0, 2.5);
}

TEST(NoiseLevel, OfCoarseVoxelsToo) {
  EXPECT_NEAR(noise_level_hu(noisy(25.0, 50.0, 1.5)).value(), 25.0, 4.0);
}

TEST(NoiseLevel, IsOfTheBoxAlone) {
  ImageVolume image = noisy(10.0);
  const ImageVolume loud = noisy(60.0);
  for (std::int64_t k = 12; k < 24; ++k)
    for (std::int64_t j = 0; j < 96; ++j)
      for (std::int64_t i = 0; i < 96; ++i) image(i, j, k) = loud(i, j, k);
  const geometry::Box3 lower(geometry::Vec3(0, 0, 0), geometry::Vec3(47, 47, 11)),
      upper(geometry::Vec3(0, 0, 12), geometry::Vec3(47, 47, 23));
  EXPECT_NEAR(noise_level_hu(image, lower).value(), 10.0, 1.0);
  EXPECT_NEAR(noise_level_hu(image, upper).value(), 60.0, 6.0);
  EXPECT_FALSE(noise_level_hu(image, geometry::Box3(geometry::Vec3(900, 0, 0), geometry::Vec3(950, 9, 9))));
}

TEST(NoiseLevel, WhereThereIsNoTissueThereIsNone) {
  ImageVolume air = noisy(10.0);
  for (std::int16_t& value : air.voxels) value = static_cast<std::int16_t>(value - 1000);
  EXPECT_FALSE(noise_level_hu(air));
}

TEST(NoiseLevel, OptionsOutOfRangeAreRefused) {
  EXPECT_THROW(noise_level_hu(noisy(10.0), {}, {1.0, -50.0, 600.0}), InvalidInput);
  EXPECT_THROW(noise_level_hu(noisy(10.0), {}, {6.0, 600.0, -50.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
