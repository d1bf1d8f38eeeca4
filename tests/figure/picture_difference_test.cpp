#include "ostia/figure/picture_difference.h"

#include "canvas.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>

namespace ostia::figure {
namespace {

Raster flat(int width, int height, std::uint8_t r, std::uint8_t g, std::uint8_t b, std::uint8_t a = 255) {
  Raster out{width, height, {}};
  for (int i = 0; i < width * height; ++i) out.rgba.insert(out.rgba.end(), {r, g, b, a});
  return out;
}

struct Parts {
  double label_x = 20.0, label_y = 30.0;
  bool button = true;
  const char* text = "Cross-section";
};

/// A small window: a label and a button on a dark ground.
Raster window(const Parts& parts) {
  return drawn(240, 120,
               [&](Canvas& canvas) {
                 canvas.fill(0, 0, 240, 120, {0.13, 0.13, 0.15});
                 canvas.text({parts.label_x, parts.label_y}, parts.text,
                             {.size_px = 12, .color = {0.9, 0.9, 0.9}});
                 if (parts.button) canvas.fill(180, 80, 24, 18, {0.25, 0.27, 0.30});
               })
      .raster();
}

TEST(PictureDifference, OfOnePictureWithItselfIsZero) {
  const PictureDifference found = picture_difference(window({}), window({}));
  EXPECT_EQ(found.worst, 0.0);
  EXPECT_EQ(found.mean, 0.0);
  EXPECT_EQ(found.delta_e.size(), 240U * 120U);
}

TEST(PictureDifference, OfFlatColoursIsThatOfCielab) {
  const auto between = [](const Raster& a, const Raster& b) { return picture_difference(a, b); };
  const Raster white = flat(50, 40, 255, 255, 255), black = flat(50, 40, 0, 0, 0),
               red = flat(50, 40, 255, 0, 0);
  EXPECT_NEAR(between(white, black).worst, 100.0, 0.05);
  EXPECT_NEAR(between(white, black).mean, 100.0, 0.05);
  // L*a*b* of sRGB red is 53.24, 80.09, 67.20.
  EXPECT_NEAR(between(white, red).worst, std::hypot(100.0 - 53.24, 80.09, 67.20), 0.1);
  EXPECT_NEAR(between(black, red).worst, std::hypot(53.24, 80.09, 67.20), 0.1);
  EXPECT_EQ(between(flat(9, 9, 200, 40, 40, 0), flat(9, 9, 0, 0, 0)).worst, 0.0) << "nothing is seen of it";
}

TEST(PictureDifference, IsSymmetric) {
  const Raster a = window({}), b = window({.text = "Slice"});
  EXPECT_DOUBLE_EQ(picture_difference(a, b).worst, picture_difference(b, a).worst);
  EXPECT_DOUBLE_EQ(picture_difference(a, b).mean, picture_difference(b, a).mean);
}

TEST(PictureDifference, WhatIsTooFineToBeSeenCountsLittle) {
  // Squares of one pixel have the mean light of an even grey: 188 of 255.
  Raster squares = flat(64, 64, 0, 0, 0);
  for (int i = 0; i < 64 * 64; ++i)
    if ((i % 64 + i / 64) % 2 == 0)
      for (std::size_t c = 0; c < 3; ++c) squares.rgba[4 * static_cast<std::size_t>(i) + c] = 255;
  const Raster grey = flat(64, 64, 188, 188, 188);
  EXPECT_LT(picture_difference(squares, grey).worst, 10.0);
  // The same squares under a lens are seen.
  EXPECT_GT(picture_difference(squares, grey, {.pixels_per_degree = 4.0}).worst, 50.0);
}

TEST(PictureDifference, AGlyphsEdgeCountsLittleAMovedOrMissingPartMuch) {
  const Raster whole = window({});
  const double edge = picture_difference(whole, window({.label_x = 20.1, .label_y = 30.1})).worst;
  const double moved = picture_difference(whole, window({.label_x = 23.0})).worst;
  const double other = picture_difference(whole, window({.text = "Cross-sections"})).worst;
  const double missing = picture_difference(whole, window({.button = false})).worst;
  EXPECT_LT(edge, 3.0);
  EXPECT_GT(moved, 8.0);
  EXPECT_GT(other, 8.0);
  EXPECT_GT(missing, 8.0);
}

TEST(PictureDifference, TellsWhere) {
  const PictureDifference found = picture_difference(window({}), window({.button = false}));
  EXPECT_GE(found.worst_x, 176);
  EXPECT_LE(found.worst_x, 192);
  EXPECT_GE(found.worst_y, 72);
  EXPECT_LE(found.worst_y, 88);
  const Raster shown = difference_picture(window({}), found);
  EXPECT_GT(shown.pixel(190, 88)[0], shown.pixel(190, 88)[1] + 100);
  EXPECT_EQ(shown.pixel(100, 100)[0], shown.pixel(100, 100)[1]);
}

TEST(PictureDifference, RefusesWhatCannotBeCompared) {
  const Raster small = flat(4, 4, 0, 0, 0), large = flat(4, 5, 0, 0, 0);
  EXPECT_THROW(picture_difference(small, large), InvalidInput);
  EXPECT_THROW(picture_difference({}, {}), InvalidInput);
  EXPECT_THROW(picture_difference({4, 4, {1, 2, 3}}, small), InvalidInput);
  EXPECT_THROW(picture_difference(small, small, {.block_px = 0}), InvalidInput);
  EXPECT_THROW(
      picture_difference(small, small, {.pixels_per_degree = std::numeric_limits<double>::quiet_NaN()}),
      InvalidInput);
  EXPECT_THROW(difference_picture(large, picture_difference(small, small)), InvalidInput);
  EXPECT_THROW(difference_picture(small, picture_difference(small, small), 0.0), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
