#include "fronts/fast_marching.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

imaging::ImageVolume uniform(const std::array<std::int64_t, 3>& size, const Vec3& spacing, std::int16_t hu) {
  imaging::ImageVolume image;
  image.geometry.size = size;
  image.geometry.spacing = spacing;
  image.voxels.assign(static_cast<std::size_t>(image.geometry.voxels()), hu);
  return image;
}

const SpeedModel kSpeed{{100.0, 500.0}, 300.0, 0.5};

TEST(FastMarching, TimesAreDistancesInAUniformImageWhateverTheSpacing) {
  const imaging::ImageVolume image = uniform({41, 31, 25}, Vec3(0.4, 0.5, 0.9), 300);
  const Vec3 source = image.geometry.world(Vec3(20.2, 15.1, 12.3));
  FrontStop stop;
  stop.all_voxels = true;
  const FrontTimes front = march(image, {source}, kSpeed, stop, core::no_task());
  ASSERT_EQ(front.order.size(), image.voxels.size());
  double worst_near = 0.0;  // voxels
  double worst_far = 0.0;   // relative
  for (const Voxel& v : front.order) {
    const double exact = (image.geometry.world(Vec3(v[0], v[1], v[2])) - source).norm();
    const double error = std::abs(front.times.get(v) - exact);
    worst_near = std::max(worst_near, error / 0.9);
    if (exact > 8.0) worst_far = std::max(worst_far, error / exact);
  }
  EXPECT_LT(worst_near, 0.4);  // the first steps away from a point are the worst
  EXPECT_LT(worst_far, 0.035);
}

TEST(FastMarching, ArrivalsAreInOrder) {
  const imaging::ImageVolume image = uniform({15, 15, 15}, Vec3::Ones(), 250);
  FrontStop stop;
  stop.all_voxels = true;
  const FrontTimes front = march(image, {Vec3(7, 7, 7)}, kSpeed, stop, core::no_task());
  for (std::size_t n = 1; n < front.order.size(); ++n) {
    EXPECT_LE(front.times.get(front.order[n - 1]), front.times.get(front.order[n]) + 1e-3F);
  }
}

TEST(FastMarching, StaysInTheRangeAndStopsAfterTheTarget) {
  imaging::ImageVolume image = uniform({60, 9, 9}, Vec3::Ones(), 0);
  for (std::int64_t i = 0; i < 60; ++i) image(i, 4, 4) = 300;
  FrontStop stop;
  stop.targets = {Voxel{20, 4, 4}};
  stop.overrun = 0.0;
  stop.overrun_mm = 5.0;
  const FrontTimes front = march(image, {Vec3(5, 4, 4)}, kSpeed, stop, core::no_task());
  EXPECT_NEAR(front.target_time, 15.0, 0.2);
  for (const Voxel& v : front.order) {
    EXPECT_EQ(v[1], 4);
    EXPECT_EQ(v[2], 4);
    EXPECT_LE(v[0], 26);
  }
  EXPECT_EQ(front.times.get(Voxel{40, 4, 4}), kUnreached);
}

TEST(FastMarching, SpeedIsARampWithinTheRange) {
  EXPECT_EQ(kSpeed(99), 0.0F);
  EXPECT_EQ(kSpeed(501), 0.0F);
  EXPECT_FLOAT_EQ(kSpeed(100), 0.5F);
  EXPECT_FLOAT_EQ(kSpeed(250), 0.75F);
  EXPECT_FLOAT_EQ(kSpeed(400), 1.0F);
}

TEST(FastMarching, CanBeCancelled) {
  const imaging::ImageVolume image = uniform({40, 40, 40}, Vec3::Ones(), 300);
  const core::TaskContext task;
  task.cancel();
  FrontStop stop;
  stop.all_voxels = true;
  EXPECT_THROW(march(image, {Vec3(5, 5, 5)}, kSpeed, stop, task), Cancelled);
}

}  // namespace
}  // namespace ostia::segmentation::detail
