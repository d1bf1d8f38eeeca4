#include "ostia/figure/value_colors.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

double scale_luminance(const Color& c) {
  return 0.2126 * c.r + 0.7152 * c.g + 0.0722 * c.b;
}

TEST(ValueColors, GetBrighterAllTheWay) {
  for (int i = 0; i < 50; ++i)
    EXPECT_LT(scale_luminance(viridis(i / 50.0)), scale_luminance(viridis((i + 1) / 50.0))) << i;
  EXPECT_EQ(hex(viridis(-1.0)), "#440154");
  EXPECT_EQ(hex(viridis(9.0)), "#fde725");
  EXPECT_EQ(hex(viridis(std::nan(""))), "#808080");
}

TEST(ValueColors, TheBarRunsFromTheTopsColourToTheLowest) {
  ValueBar bar;
  bar.title = "stress, Pa";
  const Raster raster = value_bar(bar).raster();
  ASSERT_EQ(raster.height, bar.height_px);
  const auto at = [&](int y) {
    const std::uint8_t* p = raster.pixel(27, y);
    return Color{p[0] / 255.0, p[1] / 255.0, p[2] / 255.0, 1.0};
  };
  const auto expect_near = [](const Color& a, const Color& b) {
    EXPECT_NEAR(a.r, b.r, 0.02);
    EXPECT_NEAR(a.g, b.g, 0.02);
    EXPECT_NEAR(a.b, b.b, 0.02);
  };
  expect_near(at(55), viridis(1.0));
  expect_near(at(bar.height_px - 31), viridis(0.0));
  expect_near(at((52 + bar.height_px - 28) / 2), viridis(0.5));
}

TEST(ValueColors, RefusesAnEmptyRange) {
  EXPECT_THROW(value_bar({.title = "p", .low = 2.0, .high = 2.0}), InvalidInput);
  EXPECT_THROW(value_bar({.title = "p", .low = 0.0, .high = std::nan("")}), InvalidInput);
}

TEST(ValueColors, RoundsUp) {
  EXPECT_DOUBLE_EQ(round_above(0.73), 0.8);
  EXPECT_DOUBLE_EQ(round_above(8.1), 10.0);
  EXPECT_DOUBLE_EQ(round_above(2.0), 2.0);
  EXPECT_DOUBLE_EQ(round_above(230.0), 250.0);
  EXPECT_DOUBLE_EQ(round_above(0.0), 1.0);
}

}  // namespace
}  // namespace ostia::figure
