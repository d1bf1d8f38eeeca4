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

TEST(Feature, GaussianDerivativesOfAStepAreAGaussianOfTheirSigma) {
  // A step of 300 HU along x: 300 / (sqrt(2 pi) sigma) exp(-x^2 / (2 sigma^2)) per mm.
  const Vec3 spacing(0.5, 0.4, 0.8);
  const auto step = image_of({60, 14, 12}, spacing, [](auto i, auto, auto) { return i < 30 ? 0.0 : 300.0; });
  const imaging::Region region{{10, 3, 2}, {50, 9, 10}};
  for (const double sigma : {1.0, 2.0}) {
    const auto p = gaussian_gradient_magnitude(step, region, sigma);
    ASSERT_EQ(p.voxels.size(), 40U * 6U * 8U);
    EXPECT_TRUE(p.geometry.origin.isApprox(step.geometry.world(Vec3(10, 3, 2))));
    const double peak = 300.0 / (std::sqrt(2.0 * M_PI) * sigma);
    for (std::int64_t i = 0; i < 40; ++i) {
      const double x = (static_cast<double>(i + 10) - 29.5) * 0.5;
      EXPECT_NEAR(p(i, 3, 4), peak * std::exp(-x * x / (2.0 * sigma * sigma)), 0.06 * peak) << i;
    }
  }
  EXPECT_THROW(gaussian_gradient_magnitude(step, region, 0.0), InvalidInput);
  EXPECT_THROW(gaussian_gradient_magnitude(step, region, std::nan("")), InvalidInput);
  EXPECT_THROW(gaussian_gradient_magnitude(step, {{0, 0, 0}, {61, 1, 1}}, 1.0), InvalidInput);
}

TEST(Feature, GaussianDerivativesDoNotDependOnTheRegion) {
  const auto image = image_of({40, 30, 20}, Vec3(0.5, 0.6, 0.7), [](auto i, auto j, auto k) {
    return 200.0 * std::sin(0.7 * i) * std::cos(0.4 * j) + 100.0 * std::sin(0.9 * k);
  });
  const auto whole = gaussian_gradient_magnitude(image, {{0, 0, 0}, {40, 30, 20}}, 0.8);
  const auto part = gaussian_gradient_magnitude(image, {{12, 0, 9}, {17, 6, 12}}, 0.8);
  for (std::int64_t k = 0; k < 3; ++k)
    for (std::int64_t j = 0; j < 6; ++j)
      for (std::int64_t i = 0; i < 5; ++i) EXPECT_NEAR(part(i, j, k), whole(i + 12, j, k + 9), 1e-2);
}

TEST(Feature, TheBalloonIsOneMinusTauInTheVesselAndMinusTauElsewhere) {
  const auto image = image_of({6, 5, 4}, Vec3::Ones(), [](auto i, auto, auto) { return 350.0 - 50.0 * i; });
  const auto speed = balloon_speed(image, {{0, 0, 0}, {6, 5, 4}}, 350.0, 50.0, 0.2);
  for (int i = 0; i < 6; ++i) EXPECT_NEAR(speed(i, 2, 2), std::exp(-static_cast<double>(i * i)) - 0.2, 1e-6);
  EXPECT_THROW(balloon_speed(image, {{0, 0, 0}, {6, 5, 4}}, 350.0, 0.0, 0.2), InvalidInput);
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
