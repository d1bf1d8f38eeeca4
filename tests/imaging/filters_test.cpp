#include "ostia/imaging/filters.h"

#include "image_files.h"

#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::imaging {
namespace {
using testing::oblique_grid;
using testing::patterned;

FloatVolume impulse(std::int64_t n) {
  FloatVolume volume{oblique_grid(n, n, n), std::vector<float>(static_cast<std::size_t>(n * n * n), 0.0F)};
  volume(n / 2, n / 2, n / 2) = 1.0F;
  return volume;
}

TEST(GaussianBlurred, SpreadsAnImpulseByExactlySigmaAlongEveryAxis) {
  for (const double sigma_mm : {0.1, 0.3, 0.8, 1.7}) {
    const std::int64_t n = 41;
    const FloatVolume blurred = gaussian_blurred(impulse(n), sigma_mm);
    double sum = 0.0;
    Vec3 mean = Vec3::Zero(), variance = Vec3::Zero();
    for (std::int64_t k = 0; k < n; ++k)
      for (std::int64_t j = 0; j < n; ++j)
        for (std::int64_t i = 0; i < n; ++i) {
          const Vec3 at = blurred.geometry.spacing.cwiseProduct(Vec3(static_cast<double>(i - n / 2),
                                                                     static_cast<double>(j - n / 2),
                                                                     static_cast<double>(k - n / 2)));
          const double w = blurred(i, j, k);
          sum += w;
          mean += w * at;
          variance += w * at.cwiseProduct(at);
        }
    EXPECT_NEAR(sum, 1.0, 1e-5) << sigma_mm;
    EXPECT_LT(mean.norm(), 1e-5) << sigma_mm;
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(variance[axis], sigma_mm * sigma_mm, 2e-3 * sigma_mm * sigma_mm) << sigma_mm;
  }
}

TEST(GaussianBlurred, MatchesTheGaussianWhereItIsResolved) {
  FloatVolume volume = impulse(33);
  volume.geometry.spacing = Vec3::Ones();
  const double sigma = 3.0;
  const FloatVolume blurred = gaussian_blurred(volume, sigma);
  const double peak = std::pow(2.0 * M_PI * sigma * sigma, -1.5);
  for (int i = 0; i < 9; ++i)
    EXPECT_NEAR(blurred(16 + i, 16, 16), peak * std::exp(-0.5 * i * i / (sigma * sigma)), 0.05 * peak) << i;
}

TEST(GaussianBlurred, TwiceIsOnceWithTheRootOfTheSumOfSquares) {
  const FloatVolume volume = patterned<float>(oblique_grid(30, 24, 20));
  const FloatVolume twice = gaussian_blurred(gaussian_blurred(volume, 0.6), 0.8),
                    once = gaussian_blurred(volume, 1.0);
  for (std::int64_t k = 7; k < 13; ++k)  // away from the border
    for (std::int64_t i = 10; i < 20; ++i) EXPECT_NEAR(twice(i, 12, k), once(i, 12, k), 0.02);
}

TEST(GaussianBlurred, KeepsAConstantAlsoAtTheBorder) {
  FloatVolume volume = impulse(9);
  std::fill(volume.voxels.begin(), volume.voxels.end(), 1000.0F);
  for (const double sigma_mm : {0.2, 2.0, 30.0})
    for (const float v : gaussian_blurred(volume, sigma_mm).voxels) ASSERT_NEAR(v, 1000.0F, 0.01F);
}

TEST(GaussianBlurred, WithoutSigmaChangesNothing) {
  const FloatVolume volume = patterned<float>(oblique_grid(5, 6, 7));
  EXPECT_EQ(gaussian_blurred(volume, 0.0).voxels, volume.voxels);
}

TEST(GaussianBlurred, IsTheSameForAnyNumberOfThreads) {
  const FloatVolume volume = patterned<float>(oblique_grid(70, 60, 50));
  core::set_max_threads(1);
  const FloatVolume one = gaussian_blurred(volume, 0.9);
  core::set_max_threads(0);
  EXPECT_EQ(one.voxels, gaussian_blurred(volume, 0.9).voxels);
}

TEST(GaussianBlurred, RefusesBadSigmaAndCanBeCancelled) {
  const FloatVolume volume = patterned<float>(oblique_grid(5, 6, 7));
  EXPECT_THROW(gaussian_blurred(volume, -1.0), InvalidInput);
  EXPECT_THROW(gaussian_blurred(volume, std::nan("")), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(gaussian_blurred(volume, 1.0, task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
