// Axes that a person gives an image in place of those that its file says.

#include "ostia/imaging/image_axes.h"

#include "image_files.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace ostia::imaging {
namespace {

using testing::oblique_grid;

/// Every voxel another number.
ImageVolume numbered(const Geometry& grid) {
  ImageVolume image{grid, std::vector<std::int16_t>(static_cast<std::size_t>(grid.voxels()))};
  for (std::size_t n = 0; n < image.voxels.size(); ++n) image.voxels[n] = static_cast<std::int16_t>(n);
  return image;
}

Geometry straight_grid() {
  Geometry grid;
  grid.size = {4, 5, 6};
  grid.spacing = {0.5, 0.75, 2.0};
  grid.origin = {10.0, -20.0, 300.0};
  return grid;
}

std::vector<std::string> all_axes() {
  std::vector<std::string> all;
  const std::string pairs[] = {"LR", "PA", "SI"};
  for (const auto& order : {std::array{0, 1, 2}, std::array{0, 2, 1}, std::array{1, 0, 2},
                            std::array{1, 2, 0}, std::array{2, 0, 1}, std::array{2, 1, 0}})
    for (int signs = 0; signs < 8; ++signs) {
      std::string axes;
      for (int a = 0; a < 3; ++a)
        axes += pairs[order[static_cast<std::size_t>(a)]][static_cast<std::size_t>(signs >> a & 1)];
      all.push_back(axes);
    }
  return all;
}

/// Where the letters say that voxel (i, j, k) of the file lies, seen from the middle.
Vec3 place_by_letters(const Geometry& as_read, const std::string& axes, const Vec3& index) {
  const Vec3 from_middle =
      index - 0.5 * Vec3(static_cast<double>(as_read.size[0] - 1), static_cast<double>(as_read.size[1] - 1),
                         static_cast<double>(as_read.size[2] - 1));
  Vec3 place = Vec3::Zero();
  for (Eigen::Index a = 0; a < 3; ++a) {
    const char letter = axes[static_cast<std::size_t>(a)];
    const Vec3 towards = letter == 'L'   ? Vec3(1, 0, 0)
                         : letter == 'R' ? Vec3(-1, 0, 0)
                         : letter == 'P' ? Vec3(0, 1, 0)
                         : letter == 'A' ? Vec3(0, -1, 0)
                         : letter == 'S' ? Vec3(0, 0, 1)
                                         : Vec3(0, 0, -1);
    place += as_read.spacing[a] * from_middle[a] * towards;
  }
  return place;
}

TEST(ImageAxes, EveryVoxelLiesWhereTheLettersSay) {
  const Geometry as_read = straight_grid();
  const ImageVolume image = numbered(as_read);
  ASSERT_EQ(axes_of(as_read), "LPS");
  const Vec3 middle = as_read.world({1.5, 2.0, 2.5});
  ASSERT_EQ(all_axes().size(), 48U);
  for (const std::string& axes : all_axes()) {
    const ImageVolume given = with_axes(image, axes);
    EXPECT_NEAR(given.geometry.direction.determinant(), 1.0, 1e-12) << axes;
    for (std::int64_t k = 0; k < 6; ++k)
      for (std::int64_t j = 0; j < 5; ++j)
        for (std::int64_t i = 0; i < 4; ++i) {
          const Vec3 place = middle + place_by_letters(as_read, axes,
                                                       {static_cast<double>(i), static_cast<double>(j),
                                                        static_cast<double>(k)});
          const Vec3 at = given.geometry.index(place);
          ASSERT_LT((at - at.array().round().matrix()).norm(), 1e-9) << axes;
          ASSERT_EQ(given(std::lround(at.x()), std::lround(at.y()), std::lround(at.z())), image(i, j, k))
              << axes;
        }
  }
}

TEST(ImageAxes, LettersOfAnImageAreThoseItWasGiven) {
  for (const std::string& axes : all_axes()) {
    const AxesGiven given = given_axes(straight_grid(), axes);
    // Slices that are counted from the other end rise towards the other side.
    EXPECT_EQ(axes_of(given.grid).substr(0, 2), axes.substr(0, 2));
    EXPECT_EQ(axes_of(given.grid)[2] != axes[2], given.slices_reversed) << axes;
    EXPECT_EQ(given.slices_reversed, mirrored(axes, "LPS")) << axes;
  }
}

TEST(ImageAxes, ThereAndBackIsTheSameImageToTheLastBit) {
  const Geometry as_read = oblique_grid(5, 6, 7);
  const ImageVolume image = numbered(as_read);
  for (const std::string& axes : all_axes()) {
    const AxesGiven given = given_axes(as_read, axes), own = given_axes(as_read, {});
    const ImageVolume back = laid(laid(image, own, given), given, own);
    EXPECT_EQ(back.voxels, image.voxels) << axes;
    EXPECT_EQ(back.geometry.origin, as_read.origin);
    EXPECT_EQ(back.geometry.direction, as_read.direction);
  }
}

TEST(ImageAxes, AnObliqueImageStaysObliqueByAsMuchAboutItsMiddle) {
  const Geometry as_read = oblique_grid(5, 6, 7);
  const Vec3 middle = as_read.world({2.0, 2.5, 3.0});
  const auto lean = [](const Geometry& grid) {  // cosines of its axes with the nearest ones, sorted
    Vec3 cosines = grid.direction.cwiseAbs().colwise().maxCoeff().transpose();
    std::sort(cosines.data(), cosines.data() + 3);
    return cosines;
  };
  for (const std::string& axes : all_axes()) {
    const Geometry grid = given_axes(as_read, axes).grid;
    EXPECT_LT((grid.world({2.0, 2.5, 3.0}) - middle).norm(), 1e-9) << axes;
    EXPECT_LT((lean(grid) - lean(as_read)).norm(), 1e-12) << axes;
    EXPECT_LT((grid.direction.transpose() * grid.direction - Mat3::Identity()).norm(), 1e-12);
  }
}

TEST(ImageAxes, OwnAxesChangeNothing) {
  const Geometry as_read = oblique_grid(5, 6, 7);
  for (const std::string& axes : {std::string(), axes_of(as_read)}) {
    const AxesGiven given = given_axes(as_read, axes);
    EXPECT_EQ(given.grid.origin, as_read.origin);
    EXPECT_EQ(given.grid.direction, as_read.direction);
    EXPECT_FALSE(given.slices_reversed);
  }
}

TEST(ImageAxes, OtherWordsAreRefused) {
  for (const char* axes : {"", "L", "LP", "LPX", "LLS", "LRS", "lps", "LPSI", "LP S"})
    EXPECT_THROW(validate_axes(axes), InvalidInput) << axes;
  EXPECT_THROW(given_axes(straight_grid(), "XYZ"), InvalidInput);
  EXPECT_THROW(mirrored("LPS", "PA"), InvalidInput);
  EXPECT_NO_THROW(validate_axes("IAR"));
}

TEST(ImageAxes, AnEmptyImageIsNoTrouble) {
  EXPECT_TRUE(with_axes(ImageVolume{}, "LPI").voxels.empty());
}

}  // namespace
}  // namespace ostia::imaging
