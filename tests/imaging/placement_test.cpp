#include "image_files.h"
#include "shared_data.h"

#include "ostia/imaging/image_file.h"
#include "ostia/imaging/volume.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

// What becomes of a file's axes, seen through NRRD files, which can hold any.
namespace ostia::imaging {
namespace {
using namespace testing;

std::string vector_text(const Vec3& v) {
  char text[120];
  std::snprintf(text, sizeof text, "(%.17g,%.17g,%.17g)", v[0], v[1], v[2]);
  return text;
}

/// A NRRD file of `size` voxels that count 0, 1, ..., with any axes.
fs::path counted_nrrd(const std::array<std::int64_t, 3>& size, const Mat3& step, const Vec3& origin) {
  const fs::path path = ostia::testing::temporary_folder("placement") / "image.nrrd";
  write_bytes(path,
              nrrd_header({{"sizes", std::to_string(size[0]) + " " + std::to_string(size[1]) + " " +
                                         std::to_string(size[2])},
                           {"space directions", vector_text(step.col(0)) + " " + vector_text(step.col(1)) +
                                                    " " + vector_text(step.col(2))},
                           {"space origin", vector_text(origin)}}) +
                  bytes_of(counted<std::int16_t>(size[0] * size[1] * size[2])));
  return path;
}

void expect_right_handed_orthonormal(const Geometry& grid) {
  EXPECT_LT((grid.direction.transpose() * grid.direction - Mat3::Identity()).norm(), 1e-12);
  EXPECT_NEAR(grid.direction.determinant(), 1.0, 1e-12);
}

TEST(Placement, ObliqueAxesPutEveryVoxelWhereTheFileSays) {
  const Geometry grid = oblique_grid(5, 4, 3);
  const auto image =
      read_image(counted_nrrd(grid.size, grid.direction * grid.spacing.asDiagonal(), grid.origin));
  expect_right_handed_orthonormal(image.volume.geometry);
  EXPECT_TRUE(same_grid(image.volume.geometry, grid, 1e-9));
  EXPECT_TRUE(image.header.warnings.empty());
  EXPECT_EQ(image.volume(4, 2, 1), count_at(grid.size, 4, 2, 1));
}

TEST(Placement, LeftHandedAxesAreReversedWithoutMovingAVoxel) {
  const Geometry grid = oblique_grid(5, 4, 3);
  Mat3 step = grid.direction * grid.spacing.asDiagonal();
  step.col(0) *= -1.0;
  const auto image = read_image(counted_nrrd(grid.size, step, grid.origin));
  expect_right_handed_orthonormal(image.volume.geometry);
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_EQ(image.header.warnings[0], "left-handed axes: k reversed");
  for (std::int64_t k = 0; k < 3; ++k)
    for (std::int64_t j = 0; j < 4; ++j)
      for (std::int64_t i = 0; i < 5; ++i) {
        const Vec3 stored =
            grid.origin + step * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const Vec3 at = image.volume.geometry.index(stored);
        EXPECT_EQ(image.volume(std::lround(at[0]), std::lround(at[1]), std::lround(at[2])),
                  count_at(grid.size, i, j, k));
      }
}

TEST(Placement, ATinyDeviationIsMadeOrthonormalAboutTheCentre) {
  const Geometry grid = oblique_grid(101, 81, 61);
  Mat3 step = grid.direction * grid.spacing.asDiagonal();
  step.col(2) += 3e-4 * step.col(2).norm() * grid.direction.col(0);  // 0.02 degrees
  const fs::path path = counted_nrrd(grid.size, step, grid.origin);
  const ImageHeader header = read_image_header(path);
  expect_right_handed_orthonormal(header.geometry);
  EXPECT_TRUE(header.warnings.empty());
  EXPECT_EQ(header.geometry.size, grid.size);
  EXPECT_LT((header.geometry.world({50, 40, 30}) - grid.origin - step * Vec3(50, 40, 30)).norm(), 1e-9);
  EXPECT_LT((header.geometry.world({0, 0, 0}) - grid.origin).norm(), 0.05);
}

/// An affine function of the world keeps its values when a sheared image of it is resampled trilinearly.
TEST(Placement, ShearedAxesAreResampledSoThatTheWorldKeepsItsValues) {
  const std::array<std::int64_t, 3> size{30, 20, 15};
  Mat3 step = Mat3::Identity() * 2.0;
  step.col(2) = Vec3(0.0, 0.6, 2.0);  // like a tilted gantry, 16.7 degrees
  const Vec3 origin(5, 6, 7), slope(10, -20, 30);
  std::vector<float> voxels;
  for (std::int64_t k = 0; k < size[2]; ++k)
    for (std::int64_t j = 0; j < size[1]; ++j)
      for (std::int64_t i = 0; i < size[0]; ++i)
        voxels.push_back(static_cast<float>(slope.dot(
            origin + step * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)))));
  const fs::path path = ostia::testing::temporary_folder("sheared") / "image.nrrd";
  write_bytes(path, nrrd_header({{"sizes", "30 20 15"},
                                 {"type", "float"},
                                 {"space directions", "(2,0,0) (0,2,0) (0,0.6,2)"},
                                 {"space origin", "(5,6,7)"}}) +
                        bytes_of(voxels));
  const auto image = read_float_image(path);
  const Geometry& grid = image.volume.geometry;
  expect_right_handed_orthonormal(grid);
  ASSERT_EQ(image.header.warnings.size(), 1U);
  EXPECT_NE(image.header.warnings[0].find("sheared axes (16.7 degrees"), std::string::npos)
      << image.header.warnings[0];
  EXPECT_EQ(grid.size[2], 15);
  const Mat3 inverse = step.inverse();
  std::size_t checked = 0;
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j) {
      const Vec3 p = grid.world({7, static_cast<double>(j), static_cast<double>(k)});
      const Vec3 at = inverse * (p - origin);
      if ((at.array() < 0.0).any() || at[1] > 19.0 || at[2] > 14.0) continue;
      ++checked;
      EXPECT_NEAR(image.volume(7, j, k), slope.dot(p), 1e-3);
    }
  EXPECT_GT(checked, 250U);
}

TEST(Placement, AShearedMaskStaysAMask) {
  const fs::path path = ostia::testing::temporary_folder("sheared-mask") / "image.nrrd";
  std::vector<std::uint8_t> voxels(20 * 20 * 10, 0);
  std::fill(voxels.begin() + 1000, voxels.begin() + 3000, std::uint8_t{3});
  write_bytes(path, nrrd_header({{"sizes", "20 20 10"},
                                 {"type", "uchar"},
                                 {"space directions", "(1,0,0) (0,1,0) (0.3,0,1)"}}) +
                        bytes_of(voxels));
  const auto mask = read_mask(path);
  const auto ones = std::count(mask.volume.voxels.begin(), mask.volume.voxels.end(), 1);
  const auto zeros = std::count(mask.volume.voxels.begin(), mask.volume.voxels.end(), 0);
  EXPECT_EQ(static_cast<std::size_t>(ones + zeros), mask.volume.voxels.size());
  EXPECT_NEAR(static_cast<double>(ones), 2000.0, 20.0);
}

TEST(Placement, SingularAxesAreRefused) {
  Mat3 step = Mat3::Identity();
  step.col(2) = step.col(0) + step.col(1);
  const std::string message = refusal([&] {
    read_image_header(counted_nrrd({4, 3, 2}, step, Vec3::Zero()));
  });
  EXPECT_NE(message.find("image.nrrd: space directions: singular"), std::string::npos) << message;
}

TEST(Placement, ShearedAxesOfAbsurdLengthAreRefused) {
  Mat3 step = Mat3::Identity() * 1e300;
  step.col(1) = Vec3(0.7e300, 0.7e300, 0.0);
  step.col(2) = Vec3(0.0, 0.0, 1e-300);
  EXPECT_NE(refusal([&] {
              read_image_header(counted_nrrd({40, 30, 2}, step, Vec3::Zero()));
            }).find("image.nrrd: space directions"),
            std::string::npos);
  step = Mat3::Identity();
  step.col(2) = Vec3(2e9, 0.0, 2e9);  // would need 2^31 voxels along x
  EXPECT_NE(refusal([&] {
              read_image_header(counted_nrrd({4, 3, 2}, step, Vec3::Zero()));
            }).find("would not fit"),
            std::string::npos);
}

TEST(Placement, AnOriginThatIsNoNumberIsRefused) {
  EXPECT_NE(refusal([&] {
              read_image_header(counted_nrrd({4, 3, 2}, Mat3::Identity(), Vec3(0, std::nan(""), 0)));
            }).find("origin"),
            std::string::npos);
}

}  // namespace
}  // namespace ostia::imaging
