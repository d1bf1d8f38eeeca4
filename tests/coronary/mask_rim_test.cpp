#include "mask_rim.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <random>

namespace ostia::coronary {
namespace {

using imaging::MaskVolume;

constexpr std::int64_t wide = 40, deep = 60;
constexpr double voxel_mm = 0.5;

/// A tube along z in the middle of an image.
MaskVolume tube_mask(double radius_mm) {
  MaskVolume mask;
  mask.geometry.size = {wide, wide, deep};
  mask.geometry.spacing = geometry::Vec3::Constant(voxel_mm);
  mask.voxels.assign(static_cast<std::size_t>(mask.geometry.voxels()), 0);
  for (std::int64_t k = 5; k < deep - 5; ++k)
    for (std::int64_t j = 0; j < wide; ++j)
      for (std::int64_t i = 0; i < wide; ++i) {
        const double x = voxel_mm * (static_cast<double>(i) - 0.5 * wide),
                     y = voxel_mm * (static_cast<double>(j) - 0.5 * wide);
        if (std::hypot(x, y) <= radius_mm) mask(i, j, k) = 1;
      }
  return mask;
}

bool beside_other(const MaskVolume& mask, std::int64_t i, std::int64_t j, std::int64_t k) {
  const bool inside = mask(i, j, k) != 0;
  return (mask(i - 1, j, k) != 0) != inside || (mask(i + 1, j, k) != 0) != inside ||
         (mask(i, j - 1, k) != 0) != inside || (mask(i, j + 1, k) != 0) != inside ||
         (mask(i, j, k - 1) != 0) != inside || (mask(i, j, k + 1) != 0) != inside;
}

/// Each voxel on either side of the rim flipped with a probability.
MaskVolume with_noise(const MaskVolume& mask, double share, unsigned seed) {
  std::mt19937 random(seed);
  const auto least = static_cast<std::uint32_t>(share * 4294967295.0);
  MaskVolume noisy = mask;
  for (std::int64_t k = 1; k + 1 < deep; ++k)
    for (std::int64_t j = 1; j + 1 < wide; ++j)
      for (std::int64_t i = 1; i + 1 < wide; ++i)
        if (beside_other(mask, i, j, k) && random() < least) noisy(i, j, k) = mask(i, j, k) != 0 ? 0 : 1;
  return noisy;
}

std::int64_t inside_of(const MaskVolume& mask) {
  std::int64_t count = 0;
  for (const std::uint8_t label : mask.voxels) count += label != 0 ? 1 : 0;
  return count;
}

double dice_of(const MaskVolume& a, const MaskVolume& b) {
  std::int64_t both = 0;
  for (std::size_t n = 0; n < a.voxels.size(); ++n) both += a.voxels[n] != 0 && b.voxels[n] != 0 ? 1 : 0;
  return 2.0 * static_cast<double>(both) / static_cast<double>(inside_of(a) + inside_of(b));
}

TEST(MaskRim, StairsAreNotNoise) {
  for (const double radius_mm : {0.6, 1.0, 2.0, 4.0}) {
    MaskVolume mask = tube_mask(radius_mm);
    EXPECT_LT(rim_roughness(mask), 0.03) << radius_mm;
    const MaskVolume before = mask;
    EXPECT_FALSE(smooth_rough_rim(mask));
    EXPECT_EQ(mask.voxels, before.voxels);
  }
  MaskVolume empty = tube_mask(0.0);
  empty.voxels.assign(empty.voxels.size(), 0);
  EXPECT_EQ(rim_roughness(empty), 0.0);
  EXPECT_FALSE(smooth_rough_rim(empty));
}

TEST(MaskRim, ANoisyTubeComesBackWithAsManyVoxels) {
  for (const double radius_mm : {1.0, 1.5, 3.0}) {
    const MaskVolume truth = tube_mask(radius_mm), noisy = with_noise(truth, 0.25, 7);
    ASSERT_GT(rim_roughness(noisy), 0.1) << radius_mm;
    MaskVolume smooth = noisy;
    ASSERT_TRUE(smooth_rough_rim(smooth));
    EXPECT_LT(rim_roughness(smooth), 0.03) << radius_mm;
    EXPECT_NEAR(static_cast<double>(inside_of(smooth)) / static_cast<double>(inside_of(noisy)), 1.0, 0.02);
    EXPECT_LT(1.0 - dice_of(smooth, truth), 0.6 * (1.0 - dice_of(noisy, truth))) << radius_mm;
  }
}

TEST(MaskRim, AThinVesselBesideANoisyOneStaysWhole) {
  MaskVolume mask = with_noise(tube_mask(2.0), 0.3, 3);
  for (std::int64_t k = 10; k < deep - 10; ++k) mask(wide - 6, 6, k) = 1;
  ASSERT_TRUE(smooth_rough_rim(mask));
  for (std::int64_t k = 11; k < deep - 11; ++k) EXPECT_NE(mask(wide - 6, 6, k), 0) << k;
}

TEST(MaskRim, LabelsAreThoseOfTheNearestVoxels) {
  MaskVolume mask = with_noise(tube_mask(2.0), 0.25, 11);
  for (std::int64_t k = 0; k < deep; ++k)
    for (std::int64_t j = 0; j < wide; ++j)
      for (std::int64_t i = 0; i < wide; ++i)
        if (mask(i, j, k) != 0) mask(i, j, k) = k < deep / 2 ? 3 : 8;
  ASSERT_TRUE(smooth_rough_rim(mask));
  for (std::int64_t k = 0; k < deep; ++k)
    for (std::int64_t j = 0; j < wide; ++j)
      for (std::int64_t i = 0; i < wide; ++i) {
        const int label = mask(i, j, k);
        if (label == 0) continue;
        if (std::abs(k - deep / 2) > 2) {
          EXPECT_EQ(label, k < deep / 2 ? 3 : 8);
        } else {
          EXPECT_TRUE(label == 3 || label == 8);
        }
      }
}

}  // namespace
}  // namespace ostia::coronary
