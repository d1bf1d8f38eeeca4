#include "ostia/imaging/morphology.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace ostia::imaging {
namespace {

MaskVolume mask_of(const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                   const std::function<bool(const Vec3&)>& inside) {
  MaskVolume mask;
  mask.geometry.size = size;
  mask.geometry.spacing = spacing;
  for (std::int64_t n = 0; n < mask.geometry.voxels(); ++n)
    mask.voxels.push_back(inside(mask.geometry.world(Vec3(static_cast<double>(n % size[0]),
                                                          static_cast<double>(n / size[0] % size[1]),
                                                          static_cast<double>(n / (size[0] * size[1])))))
                              ? 7
                              : 0);
  return mask;
}

std::int64_t count(const MaskVolume& mask) {
  return static_cast<std::int64_t>(std::count(mask.voxels.begin(), mask.voxels.end(), 1));
}

TEST(Morphology, ABallGrowsAndShrinksByTheRadiusInMillimetres) {
  const Vec3 spacing(0.5, 0.6, 0.8), middle(8.0, 8.0, 8.0);
  const auto ball = [&](double r) {
    return mask_of({33, 27, 21}, spacing, [&](const Vec3& p) { return (p - middle).norm() <= r; });
  };
  const MaskVolume grown = dilated(ball(4.0), 2.0), shrunk = eroded(ball(6.0), 2.0);
  for (std::size_t n = 0; n < grown.voxels.size(); ++n) {
    // Between voxels' centres: within half a voxel's diagonal of the ideal ball.
    const Vec3 p = grown.geometry.world(Vec3(static_cast<double>(n % 33), static_cast<double>(n / 33 % 27),
                                             static_cast<double>(n / (33 * 27))));
    const double r = (p - middle).norm();
    if (r < 5.4) {
      ASSERT_EQ(grown.voxels[n], 1) << r;
    }
    if (r > 6.0) {
      ASSERT_EQ(grown.voxels[n], 0) << r;
    }
    if (r < 4.0) {
      ASSERT_EQ(shrunk.voxels[n], 1) << r;
    }
    if (r > 4.6) {
      ASSERT_EQ(shrunk.voxels[n], 0) << r;
    }
  }
}

TEST(Morphology, ErosionTakesNothingAwayAtTheImagesBorder) {
  const MaskVolume half = mask_of({10, 10, 10}, Vec3::Ones(), [](const Vec3& p) { return p.x() < 5.5; });
  const MaskVolume thinner = eroded(half, 2.0);
  EXPECT_EQ(count(thinner), 4 * 100);
  EXPECT_EQ(thinner(0, 0, 0), 1);
  EXPECT_EQ(count(eroded(half, 0.0)), count(dilated(half, 0.0)));
}

/// Voxel by voxel, every other one asked.
TEST(Morphology, OfScatteredVoxelsItIsWhatTheDefinitionSays) {
  std::uint32_t state = 1;
  const MaskVolume mask = mask_of({14, 11, 9}, Vec3(0.7, 0.9, 1.1), [&](const Vec3&) {
    state = state * 1664525U + 1013904223U;
    return (state >> 16) % 40 == 0;
  });
  constexpr double radius_mm = 2.3;
  const auto place = [](std::size_t n) {
    return Vec3(0.7 * static_cast<double>(n % 14), 0.9 * static_cast<double>(n / 14 % 11),
                1.1 * static_cast<double>(n / (14 * 11)));
  };
  const MaskVolume grown = dilated(mask, radius_mm), back = eroded(grown, radius_mm);
  for (std::size_t n = 0; n < mask.voxels.size(); ++n) {
    bool near_object = false, near_background = false;
    for (std::size_t m = 0; m < mask.voxels.size(); ++m) {
      if ((place(n) - place(m)).norm() > radius_mm) continue;
      near_object |= mask.voxels[m] != 0;
      near_background |= grown.voxels[m] == 0;
    }
    ASSERT_EQ(grown.voxels[n], near_object ? 1 : 0) << n;
    ASSERT_EQ(back.voxels[n], near_background ? 0 : 1) << n;
  }
}

TEST(Morphology, PartsAreConnectedThroughFacesAlone) {
  MaskVolume mask = mask_of({6, 5, 4}, Vec3::Ones(), [](const Vec3&) { return false; });
  for (const auto& [i, j, k] :
       {std::array{0, 0, 0}, std::array{1, 0, 0}, std::array{2, 1, 0}, std::array{5, 4, 3}})
    mask(i, j, k) = 1;
  const Components parts = components(mask);
  EXPECT_THAT(parts.voxels, ::testing::ElementsAre(116, 2, 1, 1));
  EXPECT_EQ(parts.label[0], parts.label[1]);
  EXPECT_NE(parts.label[1], parts.label[2 + 6]);
}

TEST(Morphology, FillsBrightHolesAndLeavesDarkOnes) {
  // Two tubes along z that end at the border: one holds 200 HU, the other 20.
  const auto ring = [](const Vec3& p, double x) { return std::hypot(p.x() - x, p.y() - 8.0); };
  MaskVolume mask = mask_of({33, 17, 9}, Vec3::Ones(), [&](const Vec3& p) {
    return (ring(p, 8.0) > 3.0 && ring(p, 8.0) < 5.5) || (ring(p, 24.0) > 3.0 && ring(p, 24.0) < 5.5);
  });
  ImageVolume image{mask.geometry, {}};
  for (std::int64_t n = 0; n < mask.geometry.voxels(); ++n) image.voxels.push_back(n % 33 < 16 ? 200 : 20);
  fill_bright_holes(mask, image, 100.0);
  EXPECT_EQ(mask(8, 8, 0), 1);
  EXPECT_EQ(mask(8, 8, 8), 1);
  EXPECT_EQ(mask(24, 8, 4), 0);
  EXPECT_EQ(mask(8, 1, 4), 0);
}

TEST(Morphology, RefusesWhatItCannotUse) {
  MaskVolume mask = mask_of({4, 4, 4}, Vec3::Ones(), [](const Vec3&) { return true; });
  EXPECT_THROW(dilated(mask, -1.0), InvalidInput);
  EXPECT_THROW(eroded(mask, std::nan("")), InvalidInput);
  ImageVolume other;
  other.geometry.size = {3, 3, 3};
  other.voxels.resize(27);
  EXPECT_THROW(fill_bright_holes(mask, other, 0.0), InvalidInput);
  mask.voxels.pop_back();
  EXPECT_THROW(components(mask), InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
