#include "ostia/view/volume_light.h"

#include "ostia/geometry/vec.h"

#include <gtest/gtest.h>

namespace ostia::view {
namespace {

/// 48 mm each way at 1 mm; dense where `solid` says so, air elsewhere.
template <class Solid>
imaging::ImageVolume block_of(const Solid& solid) {
  imaging::ImageVolume image;
  image.geometry.size = {48, 48, 48};
  image.voxels.assign(48U * 48U * 48U, -1000);
  for (std::int64_t k = 0; k < 48; ++k)
    for (std::int64_t j = 0; j < 48; ++j)
      for (std::int64_t i = 0; i < 48; ++i)
        if (solid(i, j, k)) image(i, j, k) = 400;
  return image;
}

float light_at(const imaging::ImageVolume& image, const std::vector<float>& light, std::int64_t i,
               std::int64_t j, std::int64_t k) {
  return light[static_cast<std::size_t>(image.geometry.offset(i, j, k))];
}

TEST(AmbientLight, IsAllInTheOpenNoneInsideAndHalfOnAPlane) {
  const imaging::ImageVolume image = block_of([](auto, auto, auto k) { return k < 24; });
  const std::vector<float> light = ambient_light(image);
  EXPECT_FLOAT_EQ(light_at(image, light, 24, 24, 40), 1.0F);
  EXPECT_NEAR(light_at(image, light, 24, 24, 12), 0.0F, 1e-5F);
  // The last voxel that is solid: 4 of 7 and 9 of 17 about it are.
  EXPECT_NEAR(light_at(image, light, 24, 24, 23), 1.0 - 0.5 * 4.0 / 7.0 - 0.5 * 9.0 / 17.0, 1e-5);
}

TEST(AmbientLight, IsLessInAGrooveThanOnARidge) {
  const imaging::ImageVolume groove =
      block_of([](auto i, auto, auto k) { return k < 24 && !(i >= 22 && i < 26 && k >= 16); });
  const imaging::ImageVolume ridge =
      block_of([](auto i, auto, auto k) { return k < 16 || (i >= 22 && i < 26 && k < 24); });
  const float low = light_at(groove, ambient_light(groove), 24, 24, 15),
              plain = 1.0F - 0.5F * 4.0F / 7.0F - 0.5F * 9.0F / 17.0F,
              high = light_at(ridge, ambient_light(ridge), 24, 24, 23);
  EXPECT_LT(low, plain - 0.1F);
  EXPECT_GT(high, plain + 0.1F);
}

}  // namespace
}  // namespace ostia::view
