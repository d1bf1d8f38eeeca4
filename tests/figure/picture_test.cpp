#include "ostia/figure/picture.h"

#include "canvas.h"
#include "png_bytes.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <cairo.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace ostia::figure {
namespace {

Picture sample_picture() {
  Raster image{2, 2, {255, 0, 0, 255, 0, 255, 0, 255, 0, 0, 255, 255, 9, 9, 9, 128}};
  return drawn(60, 40, [&](Canvas& canvas) {
    canvas.fill(0, 0, 60, 40, {1, 1, 1});
    canvas.image(image, 5, 5, 20, 20);
    canvas.text({30, 10}, "12 mm", {.size_px = 9});
  });
}

std::uint32_t big_endian(const std::string& bytes, std::size_t at) {
  std::uint32_t value = 0;
  for (std::size_t i = 0; i < 4; ++i) value = (value << 8) | static_cast<std::uint8_t>(bytes[at + i]);
  return value;
}

TEST(Picture, PngHasItsSignatureAndSize) {
  const std::string png = sample_picture().png(2.0);
  EXPECT_EQ(png.substr(0, 8), "\x89PNG\r\n\x1a\n");
  EXPECT_EQ(png.substr(12, 4), "IHDR");
  EXPECT_EQ(big_endian(png, 16), 120U);
  EXPECT_EQ(big_endian(png, 20), 80U);
  EXPECT_EQ(png.substr(png.size() - 8, 4), "IEND");
}

/// As Cairo, which did not write them, reads the bytes.
std::vector<std::uint32_t> read_png(const std::string& bytes, int& width, int& height) {
  std::string_view rest(bytes);
  const auto next = [](void* left, unsigned char* out, unsigned int count) {
    auto& text = *static_cast<std::string_view*>(left);
    if (text.size() < count) return CAIRO_STATUS_READ_ERROR;
    std::copy_n(text.begin(), count, out);
    text.remove_prefix(count);
    return CAIRO_STATUS_SUCCESS;
  };
  cairo_surface_t* surface = cairo_image_surface_create_from_png_stream(next, &rest);
  EXPECT_EQ(cairo_surface_status(surface), CAIRO_STATUS_SUCCESS);
  width = cairo_image_surface_get_width(surface);
  height = cairo_image_surface_get_height(surface);
  std::vector<std::uint32_t> pixels;
  for (int y = 0; y < height; ++y)
    for (int x = 0; x < width; ++x) {
      std::uint32_t pixel = 0;
      std::memcpy(&pixel,
                  cairo_image_surface_get_data(surface) + y * cairo_image_surface_get_stride(surface) + 4 * x,
                  4);
      pixels.push_back(pixel & 0xFFFFFFU);
    }
  cairo_surface_destroy(surface);
  return pixels;
}

TEST(Picture, PngHasEveryPixel) {
  for (const auto& [width, height] :
       {std::pair(1, 1), std::pair(1, 9), std::pair(37, 1), std::pair(300, 211)}) {
    // Flat, then in steps along rows and columns, then noise: each row is told in another way.
    std::vector<std::uint32_t> made;
    std::uint32_t state = 5;
    for (int y = 0; y < height; ++y)
      for (int x = 0; x < width; ++x) {
        state = state * 1664525U + 1013904223U;
        const auto column = static_cast<std::uint32_t>(x), row = static_cast<std::uint32_t>(y);
        made.push_back(0xFF000000U | (y % 50 < 10   ? 0xFFFFFFU
                                      : y % 50 < 25 ? (3U * column & 255U) * 0x010101U
                                      : y % 50 < 40 ? (row & 255U) << 8 | (state >> 9 & 255U) * 0x010001U % 7
                                                    : state & 0xFFFFFFU));
      }
    const std::string png =
        png_bytes(reinterpret_cast<const unsigned char*>(made.data()), width, height, 4 * width);
    int read_width = 0, read_height = 0;
    const std::vector<std::uint32_t> read = read_png(png, read_width, read_height);
    ASSERT_EQ(read_width, width);
    ASSERT_EQ(read_height, height);
    for (std::size_t i = 0; i < made.size(); ++i) ASSERT_EQ(read[i], made[i] & 0xFFFFFFU) << i;
  }
}

TEST(Picture, SvgAndPdfAreWholeDocumentsOfThePictureSize) {
  const std::string svg = sample_picture().svg();
  EXPECT_NE(svg.find("<svg"), std::string::npos);
  EXPECT_NE(svg.find("width=\"60px\" height=\"40px\""), std::string::npos) << svg.substr(0, 300);
  EXPECT_NE(svg.find("</svg>"), std::string::npos);
  const std::string pdf = sample_picture().pdf();
  EXPECT_EQ(pdf.substr(0, 5), "%PDF-");
  EXPECT_NE(pdf.find("/MediaBox [ 0 0 45 30 ]"), std::string::npos);
  EXPECT_NE(pdf.rfind("%%EOF"), std::string::npos);
}

TEST(Picture, TheSamePictureGivesTheSameBytesAndNoDate) {
  EXPECT_EQ(sample_picture().png(), sample_picture().png());
  EXPECT_EQ(sample_picture().svg(), sample_picture().svg());
  const std::string pdf = sample_picture().pdf();
  EXPECT_EQ(pdf, sample_picture().pdf());
  EXPECT_EQ(pdf.find("CreationDate"), std::string::npos);
}

TEST(Picture, WritesByExtensionAndRefusesOthers) {
  const auto folder = testing::temporary_folder("picture");
  for (const char* name : {"a.png", "a.svg", "a.pdf"}) {
    sample_picture().write(folder / name);
    EXPECT_GT(std::filesystem::file_size(folder / name), 100U);
  }
  EXPECT_EQ(core::read_file(folder / "a.png"), sample_picture().png());
  EXPECT_THROW(sample_picture().write(folder / "a.bmp"), InvalidInput);
  EXPECT_THROW(sample_picture().write(folder / "a.png" / "b.png"), IoError);
  EXPECT_THROW(sample_picture().png(0.0), InvalidInput);
  EXPECT_THROW(sample_picture().png(1e9), InvalidInput);
}

TEST(Picture, RasterHasStraightAlpha) {
  const Picture picture = drawn(2, 1, [](Canvas& c) { c.fill(0, 0, 1, 1, {1.0, 0.5, 0.0, 0.5}); });
  const Raster raster = picture.raster();
  EXPECT_NEAR(raster.pixel(0, 0)[0], 255, 1);
  EXPECT_NEAR(raster.pixel(0, 0)[1], 128, 2);
  EXPECT_NEAR(raster.pixel(0, 0)[3], 128, 1);
  EXPECT_EQ(raster.pixel(1, 0)[3], 0);
}

TEST(Picture, OfARasterShowsItAtTheWidthAsked) {
  Raster image{4, 2, std::vector<std::uint8_t>(32, 77)};
  EXPECT_EQ(picture_of(image).width(), 4);
  EXPECT_EQ(picture_of(image, 100.0).height(), 50);
  image.rgba.pop_back();
  EXPECT_THROW(picture_of(image), InvalidInput);
  EXPECT_THROW(picture_of(Raster{}), InvalidInput);
}

TEST(Grid, LaysPanelsInRowsWithGaps) {
  const auto panel = [](int w, int h, const Color& color) {
    return drawn(w, h, [=](Canvas& c) { c.fill(0, 0, w, h, color); });
  };
  const Picture all = grid({panel(30, 20, {1, 0, 0}), panel(40, 10, {0, 1, 0}), panel(10, 50, {0, 0, 1})},
                           {.columns = 2, .gap_px = 5});
  EXPECT_EQ(all.width(), 5 + 30 + 5 + 40 + 5);
  EXPECT_EQ(all.height(), 5 + 20 + 5 + 50 + 5);
  const Raster raster = all.raster();
  EXPECT_EQ(raster.pixel(6, 6)[0], 255);
  EXPECT_EQ(raster.pixel(41, 6)[1], 255);
  EXPECT_EQ(raster.pixel(6, 31)[2], 255);
  EXPECT_THROW(grid({}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
