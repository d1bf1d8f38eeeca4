#include "ostia/segmentation/intensity_range.h"

#include "range_about_seeds.h"
#include "tube_images.h"

#include "ostia/core/error.h"
#include "ostia/segmentation/colliding_fronts.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::segmentation {
namespace {

using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

const testing::Tube kTube{{8, 8, 3}, {8, 8, 21}, 2.0};

imaging::ImageVolume image() {
  return testing::tube_image({kTube}, {40, 40, 60}, Vec3(0.4, 0.4, 0.4), 0.4, 20.0);
}

TEST(IntensityRange, LiesBetweenLumenAndBackground) {
  const IntensityRange range = intensity_range_around(image(), {kTube.from, kTube.to});
  EXPECT_GT(range.lower, 150.0);
  EXPECT_LT(range.lower, 300.0);
  EXPECT_GT(range.upper, 450.0);
}

TEST(IntensityRange, FollowsTheImagesContrast) {
  const auto faint = testing::tube_image({kTube}, {40, 40, 60}, Vec3(0.4, 0.4, 0.4), 0.4, 5.0, 220.0, 60.0);
  const IntensityRange range = intensity_range_around(faint, {kTube.from, kTube.to});
  EXPECT_GT(range.lower, 100.0);
  EXPECT_LT(range.lower, 200.0);
}

TEST(IntensityRange, WhatIsGivenStays) {
  const detail::ChosenRange half = detail::choose_range(image(), {kTube.from}, 123.0, std::nullopt);
  EXPECT_EQ(half.range.lower, 123.0);
  EXPECT_TRUE(half.chosen);
  const detail::ChosenRange full = detail::choose_range(image(), {kTube.from}, 123.0, 456.0);
  EXPECT_EQ(full.range.upper, 456.0);
  EXPECT_FALSE(full.chosen);
}

TEST(IntensityRange, SeedsThatCannotBeAreNamed) {
  imaging::ImageVolume lung = image();
  for (auto& hu : lung.voxels) hu = static_cast<std::int16_t>(hu - 900);
  EXPECT_THAT([&] { intensity_range_around(image(), {Vec3(8, 8, -30)}); },
              ThrowsMessage<InvalidInput>(HasSubstr("(8.0, 8.0, -30.0) mm lies outside the image")));
  EXPECT_THAT([&] { intensity_range_around(lung, {kTube.from}); },
              ThrowsMessage<InvalidInput>(HasSubstr("lies in air")));
  EXPECT_THROW(intensity_range_around(image(), {}), InvalidInput);
  EXPECT_THROW(detail::choose_range(image(), {kTube.from}, 500.0, 400.0), InvalidInput);
}

TEST(IntensityRange, ASeedWithoutContrastBesideOneWithItIsRefused) {
  const Vec3 beside(13.2, 8.0, 12.0);
  const auto message = [&](const char* part) { return ThrowsMessage<InvalidInput>(HasSubstr(part)); };
  const auto choose = [&] { intensity_range_around(image(), {kTube.from, beside}); };
  EXPECT_THAT(choose, message("seed (13.2, 8.0, 12.0) mm has"));
  EXPECT_THAT(choose, message("but seed (8.0, 8.0, 3.0) mm 3"));
  // Who says where lumen begins is believed.
  EXPECT_NO_THROW(detail::choose_range(image(), {kTube.from, beside}, 20.0, std::nullopt));
}

TEST(IntensityRange, ContrastMayFallToHalfAlongTheVessel) {
  imaging::ImageVolume fading = image();
  for (std::int64_t n = 0; n < fading.geometry.voxels(); ++n) {
    const double part = 1.0 - 0.55 * static_cast<double>(n / 1600) / 59.0;
    auto& hu = fading.voxels[static_cast<std::size_t>(n)];
    hu = static_cast<std::int16_t>(50.0 + part * (hu - 50.0));
  }
  const IntensityRange range = intensity_range_around(fading, {kTube.from, kTube.to});
  EXPECT_GT(range.lower, 90.0);
  EXPECT_LT(range.lower, 190.0);
}

TEST(IntensityRange, ASeedOnADarkVoxelMovesToItsNeighbour) {
  imaging::ImageVolume dark = image();
  dark(20, 20, 20) = 0;
  const Vec3 seed = dark.geometry.world(Vec3(20.3, 20, 20));
  const detail::Voxel v = detail::voxel_in_range(dark, seed, {250.0, 600.0});
  EXPECT_EQ(v, (detail::Voxel{21, 20, 20}));
  EXPECT_THAT(
      [&] {
        detail::voxel_in_range(dark, Vec3(1, 1, 5), {250.0, 600.0});
      },
      ThrowsMessage<InvalidInput>(HasSubstr("the range is 250 to 600 HU")));
}

}  // namespace
}  // namespace ostia::segmentation
