#include "ostia/reformat/plane_image.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::reformat {
namespace {

/// A rotated image whose value is 10 x + 20 y - 5 z in world millimetres.
imaging::FloatVolume ramp() {
  imaging::FloatVolume image;
  image.geometry.size = {30, 25, 20};
  image.geometry.spacing = {0.7, 0.8, 1.1};
  image.geometry.origin = {-10, -9, 40};
  image.geometry.direction = Eigen::AngleAxisd(0.4, Vec3(1, -1, 2).normalized()).toRotationMatrix();
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (int k = 0; k < 20; ++k) {
    for (int j = 0; j < 25; ++j) {
      for (int i = 0; i < 30; ++i) {
        image(i, j, k) = static_cast<float>(image.geometry.world(Vec3(i, j, k)).dot(Vec3(10, 20, -5)));
      }
    }
  }
  return image;
}

TEST(PlaneImage, ReproducesALinearFieldAtEveryPixelCentre) {
  const imaging::FloatVolume image = ramp();
  const Vec3 middle = image.geometry.world(Vec3(14.5, 12, 9.5));
  const Plane plane = coronal_plane(image.geometry, middle, 0.5);
  const PlaneImage picture = slice(image, plane);
  int inside = 0;
  for (int row = 0; row < plane.height; ++row) {
    for (int column = 0; column < plane.width; ++column) {
      const Vec3 p = world(plane, Vec2(column + 0.5, row + 0.5));
      const Vec3 index = image.geometry.index(p);
      const Vec3 last(29, 24, 19);
      if ((index.array() < 0).any() || (index.array() > last.array()).any()) continue;
      ++inside;
      EXPECT_NEAR(picture(column, row), p.dot(Vec3(10, 20, -5)), 1e-3);
    }
  }
  EXPECT_GT(inside, 300);
}

TEST(PlaneImage, OutsideTheImageIsNotANumber) {
  const imaging::FloatVolume image = ramp();
  Plane plane = axial_plane(image.geometry, image.geometry.world(Vec3(15, 12, 10)), 0.5);
  const PlaneImage picture = slice(image, plane);
  EXPECT_TRUE(std::isnan(picture(0, 0)));  // the corner of a box about a rotated image
  EXPECT_FALSE(std::isnan(picture(plane.width / 2, plane.height / 2)));
  plane.origin.z() += 1000.0;
  for (const float value : slice(image, plane).values) EXPECT_TRUE(std::isnan(value));
}

TEST(PlaneImage, DoesNotDependOnTheNumberOfThreads) {
  const imaging::FloatVolume image = ramp();
  const Plane plane = sagittal_plane(image.geometry, image.geometry.world(Vec3(15, 12, 10)), 0.3);
  core::set_max_threads(1);
  const std::vector<float> one = slice(image, plane, imaging::Interpolation::cubic).values;
  core::set_max_threads(4);
  const std::vector<float> four = slice(image, plane, imaging::Interpolation::cubic).values;
  core::set_max_threads(0);
  ASSERT_EQ(one.size(), four.size());
  for (std::size_t i = 0; i < one.size(); ++i) {
    ASSERT_TRUE(one[i] == four[i] || (std::isnan(one[i]) && std::isnan(four[i]))) << i;
  }
}

TEST(PlaneImage, RefusesEmptyImagesAndCanBeCancelled) {
  const imaging::FloatVolume image = ramp();
  const Plane plane = axial_plane(image.geometry, image.geometry.origin);
  EXPECT_THROW(slice(imaging::ImageVolume{}, plane), InvalidInput);
  EXPECT_THROW(slice(image, Plane{}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(slice(image, plane, imaging::Interpolation::trilinear, task), Cancelled);
}

}  // namespace
}  // namespace ostia::reformat
