#include "dicom_resample.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::imaging {
namespace {

/// Value of a linear field at a world point: linear interpolation must give it back.
double field(const Vec3& p) {
  return 100.0 + 8.0 * p[0] - 6.0 * p[1] + 4.0 * p[2];
}

ImageVolume sampled(const SliceStack& stack) {
  ImageVolume image;
  image.geometry.size = {24, 20, static_cast<std::int64_t>(stack.depth_mm.size())};
  image.geometry.spacing = Vec3(0.5, 0.75, 1.0);
  image.geometry.origin = Vec3(-3, 7, 11);
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k) {
    const std::size_t s = static_cast<std::size_t>(k);
    for (std::int64_t j = 0; j < 20; ++j) {
      for (std::int64_t i = 0; i < 24; ++i) {
        const Vec3 p = image.geometry.origin + Vec3(0.5 * static_cast<double>(i) + stack.shift_x_mm[s],
                                                    0.75 * static_cast<double>(j) + stack.shift_y_mm[s],
                                                    stack.depth_mm[s]);
        image(i, j, k) = static_cast<std::int16_t>(std::lround(field(p)));
      }
    }
  }
  return image;
}

/// Largest difference from the field, leaving out what is outside.
double worst(const ImageVolume& image, std::size_t& inside) {
  double largest = 0.0;
  inside = 0;
  for (std::int64_t k = 0; k < image.geometry.size[2]; ++k) {
    for (std::int64_t j = 1; j + 1 < image.geometry.size[1]; ++j) {
      for (std::int64_t i = 1; i + 1 < image.geometry.size[0]; ++i) {
        // Away from the border, where values beyond the last pixel are made up.
        bool border = false;
        for (int dj = -1; dj <= 1; ++dj) {
          for (int di = -1; di <= 1; ++di) border = border || image(i + di, j + dj, k) == -9999;
        }
        if (border) continue;
        ++inside;
        const Vec3 p = image.geometry.world(
            Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        largest = std::max(largest, std::abs(image(i, j, k) - field(p)));
      }
    }
  }
  return largest;
}

TEST(Restacked, EvenStackKeepsItsValues) {
  const SliceStack stack{{0, 2, 4, 6}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  const ImageVolume in = sampled(stack), out = restacked(in, stack, 4, -9999, core::no_task());
  EXPECT_EQ(out.voxels, in.voxels);
  EXPECT_DOUBLE_EQ(out.geometry.spacing[2], 2.0);
}

TEST(Restacked, WholePixelShiftsKeepValues) {
  const SliceStack stack{{0, 2, 4}, {0, 0.5, 1.0}, {0, -0.75, -1.5}};
  const ImageVolume in = sampled(stack), out = restacked(in, stack, 3, -9999, core::no_task());
  EXPECT_EQ(out.geometry.size[0], 26);
  EXPECT_EQ(out.geometry.size[1], 22);
  for (std::int64_t k = 0; k < 3; ++k) {
    for (std::int64_t j = 0; j < 20; ++j) {
      for (std::int64_t i = 0; i < 24; ++i)
        ASSERT_EQ(out(i + k, j + 2 - k, k), in(i, j, k)) << i << ' ' << j << ' ' << k;
    }
  }
  EXPECT_EQ(out(25, 10, 0), -9999);
}

TEST(Restacked, TiltedStackIsPutRight) {
  SliceStack stack;
  for (int k = 0; k < 12; ++k) {
    stack.depth_mm.push_back(1.3 * k);
    stack.shift_x_mm.push_back(0.0);
    stack.shift_y_mm.push_back(1.3 * k * std::tan(0.3));
  }
  std::size_t inside = 0;
  const ImageVolume out = restacked(sampled(stack), stack, 12, -9999, core::no_task());
  EXPECT_LE(worst(out, inside), 4.5);  // half a pixel of made-up border on one side: 6 * 0.75
  EXPECT_GT(inside, 4000u);
}

TEST(Restacked, MissingSlicesAreInterpolated) {
  const SliceStack stack{{0, 1, 4, 5}, {0, 0, 0, 0}, {0, 0, 0, 0}};
  const ImageVolume out = restacked(sampled(stack), stack, 6, -9999, core::no_task());
  std::size_t inside = 0;
  EXPECT_LE(worst(out, inside), 1.0);
  EXPECT_EQ(out.geometry.size[2], 6);
  EXPECT_EQ(inside, 6u * 22u * 18u);
}

TEST(Restacked, DoesNotDependOnThreads) {
  const SliceStack stack{{0, 1.1, 4.2, 5}, {0, 0.2, 0.3, 0.9}, {0, 0.1, 0.7, 0.8}};
  const ImageVolume in = sampled(stack);
  const int before = core::max_threads();
  core::set_max_threads(1);
  const ImageVolume one = restacked(in, stack, 7, 0, core::no_task());
  core::set_max_threads(before);
  EXPECT_EQ(one.voxels, restacked(in, stack, 7, 0, core::no_task()).voxels);
}

TEST(Restacked, CanBeCancelled) {
  const SliceStack stack{{0, 1}, {0, 0}, {0, 0}};
  const ImageVolume in = sampled(stack);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(restacked(in, stack, 2, 0, task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
