#include "outer_wall/wall_blur.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

constexpr double spacing_mm = 0.5, radius_mm = 8.0;

/// A ball's wall, blurred by a Gaussian of these deviations along the axes: to first order in its curvature
/// the normal distribution of the distance from it, with the blur's deviation along the normal.
imaging::ImageVolume blurred_ball(const Vec3& sigma_mm) {
  imaging::ImageVolume image;
  image.geometry.size = {48, 48, 48};
  image.geometry.spacing = Vec3::Constant(spacing_mm);
  image.geometry.origin = Vec3::Constant(-23.5 * spacing_mm);
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  std::size_t at = 0;
  for (int k = 0; k < 48; ++k)
    for (int j = 0; j < 48; ++j)
      for (int i = 0; i < 48; ++i) {
        const Vec3 p = image.geometry.world(Vec3(i, j, k));
        const double across = sigma_mm.cwiseProduct(p).norm() / p.norm();
        const double share = 0.5 * std::erfc((p.norm() - radius_mm) / (std::sqrt(2.0) * across));
        image.voxels[at++] = static_cast<std::int16_t>(std::lround(1000.0 * share));
      }
  return image;
}

std::vector<std::int64_t> near_the_wall(const imaging::ImageVolume& image) {
  std::vector<std::int64_t> found;
  for (std::size_t n = 0; n < image.voxels.size(); ++n)
    if (image.voxels[n] > 100 && image.voxels[n] < 900) found.push_back(static_cast<std::int64_t>(n));
  return found;
}

TEST(WallBlur, IsThatOfTheScanAndOfTheSpline) {
  const Vec3 sigma(0.4, 0.5, 0.9);
  const imaging::ImageVolume image = blurred_ball(sigma);
  const Vec3 found = wall_blur(image, image.geometry, near_the_wall(image));
  for (int d = 0; d < 3; ++d) {
    const double expected = sigma[d] * sigma[d] + spacing_mm * spacing_mm / 3.0;
    EXPECT_NEAR(found[d] / expected, 1.0, 0.15) << d;
  }
}

TEST(WallBlur, IsNotToldWhereItIsAlikeOrWhereWallsAreFew) {
  const imaging::ImageVolume alike = blurred_ball(Vec3::Constant(0.5));
  EXPECT_EQ(wall_blur(alike, alike.geometry, near_the_wall(alike)), Vec3(Vec3::Ones()));
  const imaging::ImageVolume image = blurred_ball({0.4, 0.4, 0.9});
  std::vector<std::int64_t> few = near_the_wall(image);
  few.resize(100);
  EXPECT_EQ(wall_blur(image, image.geometry, few), Vec3(Vec3::Ones()));
}

}  // namespace
}  // namespace ostia::segmentation::detail
