#include "level_set/feature_force.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

/// 3 x^2 - 2 y^2 + xz + 5y, whole numbers on voxels: its spline's derivatives are exact.
imaging::ImageVolume quadratic() {
  imaging::ImageVolume image;
  image.geometry.size = {20, 20, 20};
  image.geometry.spacing = Vec3(0.5, 0.25, 2.0);
  image.voxels.resize(8000);
  for (std::int64_t k = 0; k < 20; ++k)
    for (std::int64_t j = 0; j < 20; ++j)
      for (std::int64_t i = 0; i < 20; ++i)
        image(i, j, k) = static_cast<std::int16_t>(3 * i * i - 2 * j * j + i * k + 5 * j);
  return image;
}

TEST(FeatureForce, EdgesAreDifferentiatedExactly) {
  const auto image = quadratic();
  EdgeFeature edge;
  edge.noise_hu_per_mm = 40.0;
  edge.curvature_correction = false;
  imaging::Geometry grid = image.geometry;
  grid.origin = image.geometry.world(Vec3(2, 3, 4));
  grid.size = {12, 12, 12};
  const EdgeFeatureForce pull(image, grid, edge);
  const Vec3 at(4.3, 5.6, 3.8);  // in the grid
  const Sample sample = pull.at(at, Vec3::UnitX());
  const Vec3 p = at + Vec3(2, 3, 4);
  const Vec3 h = image.geometry.spacing;
  const Vec3 g = Vec3(6 * p[0] + p[2], -4 * p[1] + 5, p[0]).cwiseQuotient(h);
  geometry::Mat3 hessian;
  hessian << 6, 0, 1, 0, -4, 0, 1, 0, 0;
  hessian = h.cwiseInverse().asDiagonal() * hessian * h.cwiseInverse().asDiagonal();
  EXPECT_NEAR(sample.value, 0.5 * std::log1p(g.squaredNorm() / 1600.0), 1e-9);
  EXPECT_TRUE(sample.gradient.isApprox(hessian * g / (1600.0 + g.squaredNorm()), 1e-9));
}

TEST(FeatureForce, BrightIsCutWhereAsked) {
  const auto image = quadratic();
  EdgeFeature edge;
  edge.brightest_hu = -1000.0;  // below all voxels about the point: flat
  const EdgeFeatureForce pull(image, image.geometry, edge);
  EXPECT_EQ(pull.at(Vec3(15, 3, 3), Vec3::UnitX()).value, 0.0);
}

TEST(FeatureForce, AFeatureOnTheGridHasItsSlopeAndIsShiftedAgainstTheNormal) {
  imaging::FloatVolume feature;
  feature.geometry.size = {10, 10, 10};
  feature.geometry.spacing = Vec3(0.5, 1.0, 2.0);
  feature.voxels.resize(1000);
  for (std::int64_t k = 0; k < 10; ++k)
    for (std::int64_t j = 0; j < 10; ++j)
      for (std::int64_t i = 0; i < 10; ++i) feature(i, j, k) = static_cast<float>(2 * i - 3 * j + k);
  const GridFeatureForce centred(feature, 0.0);
  const Sample sample = centred.at(Vec3(4.2, 5.1, 3.3), Vec3::UnitX());
  EXPECT_NEAR(sample.value, 2 * 4.2 - 3 * 5.1 + 3.3, 1e-5);
  EXPECT_TRUE(sample.gradient.isApprox(Vec3(4.0, -3.0, 0.5), 1e-5));
  const GridFeatureForce upwind(feature, 0.5);  // half a voxel inwards along x
  EXPECT_NEAR(upwind.at(Vec3(4.2, 5.1, 3.3), Vec3::UnitX()).value, sample.value - 1.0, 1e-5);
}

}  // namespace
}  // namespace ostia::segmentation::detail
