#include "ostia/imaging/reduced_volume.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

namespace ostia::imaging {
namespace {

using geometry::Vec3;

/// A linear function of the world, on oblique axes.
double ramp(const Vec3& at) {
  return 300.0 + 2.0 * at.x() - 3.0 * at.y() + 1.5 * at.z();
}
ImageVolume oblique_ramp() {
  ImageVolume image;
  image.geometry.size = {60, 50, 37};
  image.geometry.spacing = {0.4, 0.4, 1.1};
  image.geometry.direction = Eigen::AngleAxisd(0.6, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  image.geometry.origin = {5, -20, 40};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  for (std::int64_t k = 0; k < 37; ++k)
    for (std::int64_t j = 0; j < 50; ++j)
      for (std::int64_t i = 0; i < 60; ++i)
        image(i, j, k) = static_cast<std::int16_t>(std::lround(ramp(
            image.geometry.world({static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)}))));
  return image;
}

Vec3 outer_corner(const Geometry& grid, bool last) {
  return grid.world(last ? Vec3(static_cast<double>(grid.size[0]) - 0.5,
                                static_cast<double>(grid.size[1]) - 0.5,
                                static_cast<double>(grid.size[2]) - 0.5)
                         : Vec3(-0.5, -0.5, -0.5));
}

TEST(ReducedVolume, CoversTheSameFieldWithAtMostSoManyVoxels) {
  const ImageVolume image = oblique_ramp();
  for (const std::int64_t most : {20000, 5000, 1000, 8}) {
    ReducedVolumeOptions options;
    options.most_voxels = most;
    const ImageVolume small = reduced_volume(image, options);
    EXPECT_LE(small.geometry.voxels(), most);
    EXPECT_GE(small.geometry.voxels(), most / 4);
    EXPECT_EQ(static_cast<std::int64_t>(small.voxels.size()), small.geometry.voxels());
    for (const bool last : {false, true})
      EXPECT_LT((outer_corner(small.geometry, last) - outer_corner(image.geometry, last)).norm(), 1e-9);
  }
  ReducedVolumeOptions options;
  options.most_voxels = 20000;
  const Vec3 spacing = reduced_volume(image, options).geometry.spacing;
  EXPECT_LT(spacing.maxCoeff() / spacing.minCoeff(), 1.6) << "voxels as near to cubes as can be";
}

TEST(ReducedVolume, KeepsALinearFunctionInPlace) {
  const ImageVolume image = oblique_ramp();
  ReducedVolumeOptions options;
  options.most_voxels = 4000;
  const ImageVolume small = reduced_volume(image, options);
  for (std::int64_t k = 0; k < small.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < small.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < small.geometry.size[0]; ++i)
        EXPECT_NEAR(small(i, j, k),
                    ramp(small.geometry.world(
                        {static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)})),
                    1.6);  // the mean over fractions of voxels takes each as even, and HU are whole
}

TEST(ReducedVolume, KeepsTheMeanAndDoesNotDependOnThreads) {
  const ImageVolume image = oblique_ramp();
  ReducedVolumeOptions options;
  options.most_voxels = 7000;
  const ImageVolume small = reduced_volume(image, options);
  const auto mean = [](const ImageVolume& of) {
    return std::accumulate(of.voxels.begin(), of.voxels.end(), 0.0) / static_cast<double>(of.voxels.size());
  };
  EXPECT_NEAR(mean(small), mean(image), 0.05);
  core::set_max_threads(1);
  const ImageVolume alone = reduced_volume(image, options);
  core::set_max_threads(0);
  EXPECT_EQ(alone.voxels, small.voxels);
}

TEST(ReducedVolume, TakesTheBoxAloneAndFinerForIt) {
  const ImageVolume image = oblique_ramp();
  ReducedVolumeOptions options;
  options.most_voxels = 3000;
  const Vec3 middle = image.geometry.world({30, 25, 18});
  options.box = geometry::Box3(middle - Vec3::Constant(4.0), middle + Vec3::Constant(4.0));
  const ImageVolume part = reduced_volume(image, options);
  EXPECT_LE(part.geometry.voxels(), 3000);
  for (int corner = 0; corner < 8; ++corner)
    EXPECT_TRUE(part.geometry.contains(options.box->corner(static_cast<geometry::Box3::CornerType>(corner))));
  EXPECT_NEAR(part(1, 1, 1), ramp(part.geometry.world({1, 1, 1})), 1.6);
  options.box.reset();
  EXPECT_LT(part.geometry.spacing.prod(), reduced_volume(image, options).geometry.spacing.prod());
}

TEST(ReducedVolume, ASmallImageComesBackAndBadInputIsRefused) {
  const ImageVolume image = oblique_ramp();
  EXPECT_EQ(reduced_volume(image).voxels, image.voxels);
  EXPECT_THROW(reduced_volume(ImageVolume{}), InvalidInput);
  ReducedVolumeOptions options;
  options.most_voxels = 7;
  EXPECT_THROW(reduced_volume(image, options), InvalidInput);
  options = {};
  options.box = geometry::Box3(Vec3::Constant(500.0), Vec3::Constant(510.0));
  EXPECT_THROW(reduced_volume(image, options), InvalidInput);
  options.box.reset();
  options.most_voxels = 5000;
  const core::TaskContext task = core::TaskContext();
  task.cancel();
  EXPECT_THROW(reduced_volume(image, options, task), Cancelled);
}

}  // namespace
}  // namespace ostia::imaging
