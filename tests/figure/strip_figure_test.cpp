#include "ostia/figure/strip_figure.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::figure {
namespace {

/// 10 mm wide, 30 mm long; bright in the middle 4 mm.
StripPanel panel() {
  StripPanel made{"0\xC2\xB0", 40, 120, {}, {}};
  for (int y = 0; y < 120; ++y)
    for (int x = 0; x < 40; ++x) made.values.push_back(x >= 12 && x < 28 ? 700.0F : -200.0F);
  made.contours = {{{12.0, 0.0}, {12.0, 120.0}}};
  return made;
}

/// Where a row of the picture first is of a color (to a few levels), from a column on.
int first_in_row(const Raster& raster, int y, int from, const Color& color) {
  for (int x = from; x < raster.width; ++x) {
    const std::uint8_t* p = raster.pixel(x, y);
    if (std::abs(p[0] - 255.0 * color.r) < 8 && std::abs(p[1] - 255.0 * color.g) < 8 &&
        std::abs(p[2] - 255.0 * color.b) < 8)
      return x;
  }
  return -1;
}

TEST(StripFigure, DrawsTheVesselToScale) {
  StripFigureOptions how;
  how.px_per_mm = 6.0;
  const Picture picture = strip_figure({panel(), panel()}, {}, how);
  const Raster raster = picture.raster();
  const int y = picture.height() / 2;
  const int black = first_in_row(raster, y, 60, {0.0, 0.0, 0.0});
  const int white = first_in_row(raster, y, 60, {1.0, 1.0, 1.0});
  // The black edge of 3 mm begins where the panel does; what is white before it is the paper.
  ASSERT_GE(black, 0);
  const int bright = first_in_row(raster, y, black, {1.0, 1.0, 1.0});
  EXPECT_NEAR(bright - black, 3 * 6, 3);
  const int dark = first_in_row(raster, y, bright, {0.0, 0.0, 0.0});
  EXPECT_NEAR(dark - bright, 4 * 6, 3);
  EXPECT_LE(white, bright);
  EXPECT_GE(picture.height(), 180);  // 30 mm
}

TEST(StripFigure, MarksAPlaceAtItsAbscissa) {
  const Color red{0.8, 0.1, 0.2};
  StripFigureOptions how;
  how.px_per_mm = 6.0;
  const auto row_of = [&](double at_mm) {
    const Raster raster =
        strip_figure({panel()}, {{at_mm - 2.0, at_mm + 2.0, at_mm, "S1", red}}, how).raster();
    for (int y = 0; y < raster.height; ++y)  // the tick at the panel's left edge
      if (const int x = first_in_row(raster, y, 58, red); x >= 0 && x < 66) return y;
    return -1;
  };
  const int at_ten = row_of(10.0), at_twenty = row_of(20.0);
  ASSERT_GE(at_ten, 0);
  EXPECT_NEAR(at_twenty - at_ten, 60, 1);
}

TEST(StripFigure, HoldsManyMarksAndViewsWithoutAnImage) {
  StripPanel empty = panel();
  empty.values.assign(empty.values.size(), std::numeric_limits<float>::quiet_NaN());
  std::vector<StripMark> marks;
  for (int i = 0; i < 12; ++i)
    marks.push_back({14.0, 16.0, 15.0 + 0.01 * i, "S" + std::to_string(i), palette(3)});
  const Picture picture = strip_figure({empty}, marks);
  EXPECT_EQ(picture.png(), strip_figure({empty}, marks).png());
  EXPECT_GT(picture.width(), strip_figure({empty}).width());
}

TEST(StripFigure, RefusesWhatCannotBeDrawn) {
  EXPECT_THROW(strip_figure({}), InvalidInput);
  StripPanel bad = panel();
  bad.values.pop_back();
  EXPECT_THROW(strip_figure({bad}), InvalidInput);
  StripPanel lower = panel();
  lower.height = 60;
  lower.values.resize(40 * 60);
  EXPECT_THROW(strip_figure({panel(), lower}), InvalidInput);
  for (StripFigureOptions how : {StripFigureOptions{.pixel_mm = 0.0}, StripFigureOptions{.px_per_mm = 0.1},
                                 StripFigureOptions{.window_hu = 0.0},
                                 StripFigureOptions{.level_hu = std::numeric_limits<double>::quiet_NaN()}})
    EXPECT_THROW(strip_figure({panel()}, {}, how), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
