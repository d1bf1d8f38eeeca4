#include "ostia/figure/slice_figure.h"

#include "test_shapes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::figure {
namespace {

/// 64 x 48 mm, the value of each pixel given by its world position.
template <class Value>
reformat::PlaneImage image_of(const Value& value) {
  reformat::PlaneImage image;
  image.plane.origin = {-32, -24, 10};
  image.plane.width = 64;
  image.plane.height = 48;
  for (int row = 0; row < 48; ++row) {
    for (int column = 0; column < 64; ++column) {
      image.values.push_back(
          static_cast<float>(value(reformat::world(image.plane, Vec2(column + 0.5, row + 0.5)))));
    }
  }
  return image;
}

SliceFigureOptions bare(int width) {
  SliceFigureOptions options;
  options.image_width_px = width;
  options.rulers = options.scale_bar = options.patient_letters = false;
  return options;
}

TEST(GreyLevel, MapsTheWindowToBlackAndWhite) {
  EXPECT_EQ(grey_level(-200, 250, 900), 0);
  EXPECT_EQ(grey_level(700, 250, 900), 255);
  EXPECT_EQ(grey_level(250, 250, 900), 128);
  EXPECT_EQ(grey_level(5000, 250, 900), 255);
  EXPECT_EQ(grey_level(-3000, 250, 900), 0);
  EXPECT_EQ(grey_level(std::numeric_limits<double>::quiet_NaN(), 250, 900), 0);
}

TEST(SliceFigure, ARampHasKnownGreyValues) {
  const auto image = image_of([](const Vec3& p) { return 10.0 * p.x(); });  // -315 to 315 HU
  SliceFigureOptions options = bare(64);
  options.level_hu = 0.0;
  options.window_hu = 800.0;
  const Raster raster = slice_figure(image, {}, {}, options).raster();
  ASSERT_EQ(raster.width, 64);
  ASSERT_EQ(raster.height, 48);
  for (int column = 0; column < 64; ++column) {
    const double value = 10.0 * (column + 0.5 - 32.0);
    const int expected = static_cast<int>(std::lround(255.0 * (value + 400.0) / 800.0));
    EXPECT_NEAR(raster.pixel(column, 24)[0], expected, 1) << column;
    EXPECT_EQ(raster.pixel(column, 24)[0], raster.pixel(column, 24)[2]);
  }
}

TEST(SliceFigure, ContoursLieWhereTheyAreInTheWorld) {
  const auto image = image_of([](const Vec3&) { return -1000.0; });
  const SliceContour square{
      {{{-10, -5, 10}, {10, -5, 10}, {10, 5, 10}, {-10, 5, 10}, {-10, -5, 10}}}, {1, 0, 0}, 3.0, {}};
  const Raster raster = slice_figure(image, {square}, {}, bare(640)).raster();
  const auto red = [&](const Vec2& mm) {
    const std::uint8_t* p =
        raster.pixel(static_cast<int>(10 * (mm.x() + 32)), static_cast<int>(10 * (mm.y() + 24)));
    return p[0] > 200 && p[1] < 60;
  };
  EXPECT_TRUE(red({-10, 0}));
  EXPECT_TRUE(red({10, 3}));
  EXPECT_TRUE(red({4, -5}));
  EXPECT_TRUE(red({4, 5}));
  EXPECT_FALSE(red({0, 0}));
  EXPECT_FALSE(red({12, 0}));
}

TEST(SliceFigure, ShowsPointsNearThePlaneOnly) {
  const auto image = image_of([](const Vec3&) { return -1000.0; });
  const auto greens = [&](double z) {
    const Raster raster = slice_figure(image, {}, {{{5, 5, z}, "", {0, 1, 0}}}, bare(640)).raster();
    int count = 0;
    for (int y = 0; y < raster.height; ++y) {
      for (int x = 0; x < raster.width; ++x)
        count += raster.pixel(x, y)[1] > 200 && raster.pixel(x, y)[0] < 60;
    }
    return count;
  };
  EXPECT_GT(greens(10.0), 20);
  EXPECT_GT(greens(12.5), 20);
  EXPECT_EQ(greens(14.0), 0);
}

TEST(SliceFigure, RulersAndTitleMakeRoomForThemselves) {
  const auto image = image_of([](const Vec3&) { return 0.0; });
  SliceFigureOptions options;
  options.image_width_px = 320;
  const Picture plain = slice_figure(image, {}, {}, bare(320));
  EXPECT_EQ(plain.width(), 320);
  EXPECT_EQ(plain.height(), 240);
  const Picture with_rulers = slice_figure(image, {}, {}, options);
  EXPECT_GT(with_rulers.width(), 360);
  options.title = "Title";
  EXPECT_GT(slice_figure(image, {}, {}, options).height(), with_rulers.height());
}

TEST(SliceFigure, RefusesBadInput) {
  auto image = image_of([](const Vec3&) { return 0.0; });
  EXPECT_THROW(slice_figure(reformat::PlaneImage{}), InvalidInput);
  EXPECT_THROW(slice_figure(image, {}, {}, {.window_hu = 0.0}), InvalidInput);
  EXPECT_THROW(slice_figure(image, {}, {}, {.image_width_px = 0}), InvalidInput);
  image.values.pop_back();
  EXPECT_THROW(slice_figure(image), InvalidInput);
}

TEST(ThreePlanes, ShowsAllThreeAtOneScale) {
  imaging::ImageVolume volume;
  volume.geometry.size = {20, 30, 40};
  volume.voxels.assign(20 * 30 * 40, 100);
  SliceFigureOptions options;
  options.image_width_px = 300;
  const Picture picture = three_planes(volume, {10, 15, 20}, {ball(6.0, 16, {10, 15, 20})}, {}, options);
  // 20 + 20 + 30 mm of image at 10 px/mm, three margins of rulers and four gaps.
  EXPECT_EQ(picture.width(), 700 + 3 * (62 + 16) + 4 * 12);
  EXPECT_THROW(three_planes(imaging::ImageVolume{}, {0, 0, 0}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
