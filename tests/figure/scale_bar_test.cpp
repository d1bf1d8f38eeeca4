#include "scale_bar.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

TEST(ScaleBar, IsTheLongestRoundLengthThatFits) {
  EXPECT_DOUBLE_EQ(scale_bar_mm(0.5, 100.0), 50.0);
  EXPECT_DOUBLE_EQ(scale_bar_mm(0.49, 100.0), 20.0);
  EXPECT_DOUBLE_EQ(scale_bar_mm(0.012, 100.0), 1.0);
  EXPECT_DOUBLE_EQ(scale_bar_mm(0.001, 90.0), 0.05);
}

TEST(ScaleBar, IsDrawnAsLongAsItSays) {
  constexpr double kMmPerPixel = 0.25;  // 50 px at most are 12.5 mm: a bar of 10 mm, 40 px
  const Raster raster = drawn(100, 60, [](Canvas& canvas) {
                          canvas.fill(0, 0, 100, 60, {0, 0, 0});
                          draw_scale_bar(canvas, {90, 50}, kMmPerPixel, 50.0, {1, 1, 1}, {0, 0, 0});
                        }).raster();
  int white = 0;
  for (int x = 0; x < 100; ++x) white += raster.pixel(x, 50)[0] > 127;
  EXPECT_EQ(white, 40);
}

}  // namespace
}  // namespace ostia::figure
