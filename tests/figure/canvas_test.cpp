#include "canvas.h"

#include "ostia/core/error.h"
#include "ostia/core/log.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::figure {
namespace {

Color at(const Raster& raster, int x, int y) {
  const std::uint8_t* p = raster.pixel(x, y);
  return {p[0] / 255.0, p[1] / 255.0, p[2] / 255.0, p[3] / 255.0};
}

TEST(Canvas, FillsExactlyThePixelsOfARectangle) {
  const Raster raster = drawn(20, 10, [](Canvas& c) { c.fill(3, 2, 5, 4, {1, 0, 0}); }).raster();
  int red = 0;
  for (int y = 0; y < 10; ++y) {
    for (int x = 0; x < 20; ++x) {
      const bool inside = x >= 3 && x < 8 && y >= 2 && y < 6;
      EXPECT_EQ(at(raster, x, y), inside ? (Color{1, 0, 0, 1}) : (Color{0, 0, 0, 0})) << x << ", " << y;
      red += inside;
    }
  }
  EXPECT_EQ(red, 20);
}

TEST(Canvas, ALineAfterATextIsNotJoinedToIt) {
  const Raster raster = drawn(200, 200, [](Canvas& c) {
                          c.text({4, 4}, "x", {.size_px = 12, .color = {0, 0, 1}});
                          c.polyline({{150, 190}, {190, 190}}, {1, 0, 0}, 2.0);
                        }).raster();
  for (int y = 40; y < 180; ++y) {
    for (int x = 0; x < 200; ++x) ASSERT_EQ(raster.pixel(x, y)[3], 0) << x << ", " << y;
  }
}

TEST(Canvas, AlignsTextToItsPoint) {
  const Vec2 size = Canvas::text_size("Lumen 12", 14.0);
  EXPECT_GT(size.x(), 40.0);
  EXPECT_GT(size.y(), 10.0);
  EXPECT_GT(Canvas::text_size("Lumen 12", 14.0, true).x(), size.x());
  for (const Align align : {Align::start, Align::middle, Align::end}) {
    const Raster raster =
        drawn(300, 40, [&](Canvas& c) {
          c.text({150, 5}, "Lumen 12", {.size_px = 14, .color = {1, 1, 1}, .across = align});
        }).raster();
    int first = 300;
    int last = 0;
    for (int y = 0; y < 40; ++y) {
      for (int x = 0; x < 300; ++x) {
        if (raster.pixel(x, y)[3] > 60) {
          first = std::min(first, x);
          last = std::max(last, x);
        }
      }
    }
    const double start = align == Align::start    ? 150
                         : align == Align::middle ? 150 - 0.5 * size.x()
                                                  : 150 - size.x();
    EXPECT_NEAR(first, start, 3.0);
    EXPECT_NEAR(last, start + size.x(), 3.0);
  }
}

TEST(Canvas, TextThatIsNotUtf8IsDrawnAllTheSame) {
  EXPECT_NO_THROW(drawn(50, 20, [](Canvas& c) { c.text({1, 1}, "a\xFF\xC3", {}); }).raster());
}

TEST(Canvas, WhatIsRedactedInTheLogIsRedactedInPictures) {
  core::redact_in_logs("DOE^JANE", "P1");
  EXPECT_EQ(Canvas::text_size("DOE^JANE", 12.0), Canvas::text_size("P1", 12.0));
}

TEST(Canvas, ImagesKeepTheirPixelsAtScaleOne) {
  Raster image{2, 1, {10, 20, 30, 255, 200, 100, 50, 255}};
  const Raster raster = drawn(4, 3, [&](Canvas& c) { c.image(image, 1, 1, 2, 1); }).raster();
  EXPECT_EQ(raster.pixel(1, 1)[0], 10);
  EXPECT_EQ(raster.pixel(2, 1)[0], 200);
  EXPECT_EQ(raster.pixel(2, 1)[2], 50);
  EXPECT_EQ(raster.pixel(0, 0)[3], 0);
}

TEST(Canvas, RefusesSizesThatCannotBeDrawn) {
  const auto nothing = [](Canvas&) {};
  EXPECT_THROW(drawn(0, 10, nothing), InvalidInput);
  EXPECT_THROW(drawn(10, -1, nothing), InvalidInput);
  EXPECT_THROW(drawn(40000, 10, nothing), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
