#include "ostia/segmentation/feature.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace ostia::segmentation {
namespace {

imaging::ImageVolume image_of(const std::array<std::int64_t, 3>& size, const Vec3& spacing,
                              const std::function<double(std::int64_t, std::int64_t, std::int64_t)>& f) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        image(i, j, k) = static_cast<std::int16_t>(std::lround(f(i, j, k)));
  return image;
}

TEST(Feature, ARampHasItsSlopeInBothSchemesWithTheSpacingOfEachAxis) {
  const Vec3 spacing(0.5, 0.4, 2.0);
  const auto ramp =
      image_of({12, 12, 12}, spacing, [](auto i, auto j, auto k) { return 10.0 * i - 4.0 * j + 6.0 * k; });
  const double slope = std::sqrt(20.0 * 20.0 + 10.0 * 10.0 + 3.0 * 3.0);
  const imaging::Region region{{2, 3, 4}, {9, 9, 10}};
  for (const GradientScheme scheme : {GradientScheme::centred, GradientScheme::upwind}) {
    const auto p = gradient_magnitude(ramp, region, scheme);
    ASSERT_EQ(p.voxels.size(), 7U * 6U * 6U);
    EXPECT_TRUE(p.geometry.origin.isApprox(ramp.geometry.world(Vec3(2, 3, 4))));
    for (const float value : p.voxels) EXPECT_NEAR(value, slope, 1e-3);
  }
}

TEST(Feature, UpwindLooksAtDarkerNeighboursAlone) {
  // [Antiga] eq. 4 on a row 0 0 90 60 0 0, h = 0.5.
  const std::array<double, 6> row{0, 0, 90, 60, 0, 0};
  const auto image = image_of({6, 3, 3}, Vec3(0.5, 1, 1), [&](auto i, auto, auto) { return row[i]; });
  const auto p = gradient_magnitude(image, {{0, 1, 1}, {6, 2, 2}}, GradientScheme::upwind);
  const std::array<double, 6> expected{0, 0, 180, 120, 0, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(p.voxels[i], static_cast<float>(expected[i])) << i;
  const auto c = gradient_magnitude(image, {{0, 1, 1}, {6, 2, 2}}, GradientScheme::centred);
  const std::array<double, 6> centred{0, 90, 60, 90, 60, 0};
  for (std::size_t i = 0; i < 6; ++i) EXPECT_FLOAT_EQ(c.voxels[i], static_cast<float>(centred[i])) << i;
}

TEST(Feature, CompressionKeepsOrderAndTakesTheNoiseAway) {
  imaging::FloatVolume p;
  p.geometry.size = {4, 1, 1};
  p.voxels = {0.0F, 5.0F, 100.0F, 1000.0F};
  compress_feature(p, 50.0);
  EXPECT_EQ(p.voxels[0], 0.0F);
  EXPECT_LT(p.voxels[1], 0.006F);
  EXPECT_NEAR(p.voxels[2], 0.5 * std::log(5.0), 1e-5);
  EXPECT_NEAR(p.voxels[3], 0.5 * std::log(401.0), 1e-5);
  EXPECT_THROW(compress_feature(p, 0.0), InvalidInput);
}

TEST(Feature, RegionsThatDoNotFitAreRefused) {
  const auto image = image_of({5, 5, 5}, Vec3::Ones(), [](auto, auto, auto) { return 0.0; });
  EXPECT_THROW(gradient_magnitude(image, {{0, 0, 0}, {6, 5, 5}}, GradientScheme::centred), InvalidInput);
  EXPECT_THROW(gradient_magnitude(image, {{2, 0, 0}, {2, 5, 5}}, GradientScheme::centred), InvalidInput);
}

}  // namespace
}  // namespace ostia::segmentation
