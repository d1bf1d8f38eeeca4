#include "ostia/imaging/sampling.h"

#include "image_files.h"

#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::imaging {
namespace {
using testing::oblique_grid;
using testing::patterned;

/// The volume of a function of the world.
template <class F>
FloatVolume volume_of(const Geometry& grid, const F& f) {
  FloatVolume volume{grid, {}};
  for (std::int64_t k = 0; k < grid.size[2]; ++k)
    for (std::int64_t j = 0; j < grid.size[1]; ++j)
      for (std::int64_t i = 0; i < grid.size[0]; ++i)
        volume.voxels.push_back(static_cast<float>(
            f(grid.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k))))));
  return volume;
}

const Vec3 inner[] = {{1.3, 2.6, 3.1}, {2.0, 3.0, 4.0}, {3.99, 1.01, 2.5}, {4.5, 4.25, 1.75}};

TEST(Sample, TrilinearIsExactForAffineFunctions) {
  const Geometry grid = oblique_grid(7, 7, 7);
  const Vec3 slope(3.0, -2.0, 0.5);
  const auto f = [&](const Vec3& p) { return slope.dot(p - grid.origin) + 7.0; };
  const FloatVolume volume = volume_of(grid, f);
  for (const Vec3& at : inner) {
    const Vec3 p = grid.world(at);
    EXPECT_NEAR(sample(volume, p), f(p), 1e-5);
    EXPECT_LT((sample_gradient(volume, p) - slope).norm(), 1e-4);
  }
}

TEST(Sample, CubicIsExactForQuadraticFunctions) {
  const Geometry grid = oblique_grid(8, 8, 8);
  const auto f = [&](const Vec3& p) {
    const Vec3 q = p - grid.world({3, 3, 3});
    return q[0] * q[0] - 2.0 * q[1] * q[2] + 0.5 * q[2] - 3.0;
  };
  const auto gradient = [&](const Vec3& p) {
    const Vec3 q = p - grid.world({3, 3, 3});
    return Vec3(2.0 * q[0], -2.0 * q[2], -2.0 * q[1] + 0.5);
  };
  const FloatVolume volume = volume_of(grid, f);
  for (const Vec3& at : inner) {
    const Vec3 p = grid.world(at);
    EXPECT_NEAR(sample(volume, p, Interpolation::cubic), f(p), 1e-5);
    EXPECT_LT((sample_gradient(volume, p, Interpolation::cubic) - gradient(p)).norm(), 1e-4);
  }
}

TEST(Sample, InterpolatesTheVoxels) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(5, 4, 3));
  for (const auto how : {Interpolation::nearest, Interpolation::trilinear, Interpolation::cubic})
    for (std::int64_t k = 0; k < 3; ++k)
      for (std::int64_t i = 0; i < 5; ++i)
        EXPECT_NEAR(
            sample(image, image.geometry.world({static_cast<double>(i), 2, static_cast<double>(k)}), how),
            image(i, 2, k), 1e-9);
}

TEST(Sample, GradientIsThatOfTheInterpolant) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(7, 7, 7));
  const Vec3 between[] = {{1.3, 2.6, 3.1}, {3.9, 1.1, 2.5}, {0.2, 5.8, 5.5}};
  for (const auto how : {Interpolation::trilinear, Interpolation::cubic})
    for (const Vec3& at : between) {
      const Vec3 p = image.geometry.world(at);
      const Vec3 g = sample_gradient(image, p, how);
      for (int axis = 0; axis < 3; ++axis) {
        const double h = 1e-5;
        const Vec3 step = h * Vec3::Unit(axis);
        EXPECT_NEAR(g[axis],
                    (sample(image, Vec3(p + step), how) - sample(image, Vec3(p - step), how)) / (2.0 * h),
                    1e-3);
      }
    }
}

TEST(Sample, OutsideGivesTheBordersValueAndNoGradientAcross) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(5, 4, 3));
  for (const auto how : {Interpolation::nearest, Interpolation::trilinear, Interpolation::cubic}) {
    EXPECT_NEAR(sample(image, image.geometry.world({-20, 1, 2}), how), image(0, 1, 2), 1e-9);
    EXPECT_NEAR(sample(image, image.geometry.world({99, 99, 99}), how), image(4, 3, 2), 1e-9);
    const Vec3 g = sample_gradient(image, image.geometry.world({-20, 1.5, 1.5}), how);
    EXPECT_NEAR(g.dot(image.geometry.direction.col(0)), 0.0, 1e-12);
  }
}

TEST(Sample, WorksOnASingleSlice) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(5, 4, 1));
  const Vec3 p = image.geometry.world({1.5, 2, 0});
  EXPECT_NEAR(sample(image, p), 0.5 * (image(1, 2, 0) + image(2, 2, 0)), 1e-9);
  EXPECT_NEAR(sample_gradient(image, p).dot(image.geometry.direction.col(2)), 0.0, 1e-12);
}

TEST(Sample, SurvivesPointsThatAreNoNumbers) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(5, 4, 3));
  for (const auto how : {Interpolation::nearest, Interpolation::trilinear, Interpolation::cubic}) {
    EXPECT_TRUE(std::isfinite(sample(image, Vec3::Constant(std::nan("")), how)));
    EXPECT_TRUE(std::isfinite(sample(image, Vec3::Constant(std::numeric_limits<double>::infinity()), how)));
  }
}

TEST(Resampled, OntoItsOwnGridChangesNothing) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(9, 8, 7));
  for (const auto how : {Interpolation::nearest, Interpolation::trilinear, Interpolation::cubic})
    EXPECT_EQ(resampled(image, image.geometry, how, std::int16_t{-1000}).voxels, image.voxels);
}

TEST(Resampled, AgreesWithSample) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(9, 8, 7));
  Geometry grid;
  grid.size = {8, 8, 8};
  grid.spacing = Vec3(0.6, 0.6, 0.9);
  grid.origin = image.geometry.world({1, 1, 1});
  std::size_t inside = 0;
  for (const auto how : {Interpolation::nearest, Interpolation::trilinear, Interpolation::cubic}) {
    const ImageVolume result = resampled(image, grid, how, std::int16_t{-1000});
    for (std::int64_t k = 0; k < 8; ++k)
      for (std::int64_t j = 0; j < 8; ++j)
        for (std::int64_t i = 0; i < 8; ++i) {
          const Vec3 p = grid.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)});
          if (image.geometry.contains(p)) {
            ++inside;
            EXPECT_NEAR(result(i, j, k), sample(image, p, how), 0.500001);
          } else {
            EXPECT_EQ(result(i, j, k), -1000);
          }
        }
  }
  EXPECT_GT(inside, 300U);
}

TEST(Resampled, ClampsToTheRangeOfTheType) {
  MaskVolume image{oblique_grid(6, 1, 1), {0, 0, 255, 255, 0, 0}};  // Catmull-Rom overshoots between the two
  Geometry grid = image.geometry;
  grid.size = {1, 1, 1};
  grid.origin = image.geometry.world({2.5, 0, 0});
  EXPECT_GT(sample(image, grid.origin, Interpolation::cubic), 256.0);
  EXPECT_EQ(resampled(image, grid, Interpolation::cubic, std::uint8_t{7}).voxels[0], 255);
}

TEST(Resampled, IsTheSameForAnyNumberOfThreads) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(60, 50, 40));
  Geometry grid = image.geometry;
  grid.spacing *= 0.77;
  core::set_max_threads(1);
  const ImageVolume one = resampled(image, grid, Interpolation::cubic, std::int16_t{0});
  core::set_max_threads(0);
  EXPECT_EQ(one.voxels, resampled(image, grid, Interpolation::cubic, std::int16_t{0}).voxels);
}

TEST(Resampled, CanBeCancelledAndRefusesAnEmptyImage) {
  const ImageVolume image = patterned<std::int16_t>(oblique_grid(9, 8, 7));
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(resampled(image, image.geometry, Interpolation::trilinear, std::int16_t{0}, task), Cancelled);
  EXPECT_THROW(resampled(ImageVolume{}, image.geometry, Interpolation::trilinear, std::int16_t{0}),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::imaging
