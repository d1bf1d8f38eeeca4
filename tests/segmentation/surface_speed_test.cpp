#include "surface_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

class Ramp : public Pull {  // a feature that grows along x by one a mm
 public:
  Sample at(const Vec3&, const Vec3&) const override { return {3.0, Vec3(1, 0, 0)}; }
};

imaging::FloatVolume sphere(double radius) {
  imaging::FloatVolume out;
  out.geometry.size = {48, 48, 48};
  out.geometry.spacing = Vec3::Constant(0.5);
  out.voxels.resize(48 * 48 * 48);
  for (std::int64_t n = 0; n < out.geometry.voxels(); ++n) {
    const Vec3 p = 0.5 * Vec3(static_cast<double>(n % 48), static_cast<double>(n / 48 % 48),
                              static_cast<double>(n / 2304));
    out.voxels[static_cast<std::size_t>(n)] = static_cast<float>((p - Vec3::Constant(11.75)).norm() - radius);
  }
  return out;
}

TEST(SurfaceSpeed, CurvatureIsTwiceTheInverseRadiusOnASphere) {
  const SparseField field(sphere(8.0));
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 0.1;
  const Ramp ramp;
  const SurfaceSpeed speed(field.geometry(), ramp, nullptr, options);
  double sum = 0.0;
  for (const std::int64_t n : field.active()) sum += speed.change(field, n);
  const double expected = 0.4 * 0.1 * 0.25 * (2.0 / 8.0);  // step, w2, h^2, curvature
  EXPECT_NEAR(sum / static_cast<double>(field.active().size()), expected, 0.1 * expected);
}

TEST(SurfaceSpeed, AdvectionFollowsTheFeatureUphill) {
  const SparseField field(sphere(8.0));
  LevelSetOptions options;
  options.curvature = 0.0;
  const Ramp ramp;
  const SurfaceSpeed speed(field.geometry(), ramp, nullptr, options);
  double worst = 0.0;
  double sum = 0.0;
  for (const std::int64_t n : field.active()) {
    const Vec3 out = 0.5 * Vec3(static_cast<double>(n % 48), static_cast<double>(n / 48 % 48),
                                static_cast<double>(n / 2304)) -
                     Vec3::Constant(11.75);
    // phi_t = -v . grad phi with v = h^2 (1, 0, 0) in 0.4 of a unit of time.
    const double error = std::abs(speed.change(field, n) + 0.4 * 0.25 * out.normalized().x());
    worst = std::max(worst, error);
    sum += error;
  }
  EXPECT_LT(worst, 0.05);
  EXPECT_LT(sum / static_cast<double>(field.active().size()), 0.012);
}

TEST(SurfaceSpeed, AHeldEndMovesSidewaysAlone) {
  const SparseField field(sphere(8.0));
  LevelSetOptions options;
  options.ends = {{Vec3(19.75, 11.75, 11.75), Vec3::UnitX(), 30.0}};
  const Ramp ramp;
  const SurfaceSpeed speed(field.geometry(), ramp, nullptr, options);
  for (const std::int64_t n : field.active()) {
    const double x = 0.5 * static_cast<double>(n % 48);
    if (x > 19.0) {
      EXPECT_EQ(speed.change(field, n), 0.0);
    }
    if (x < 10.0) {
      EXPECT_NE(speed.change(field, n), 0.0);
    }
  }
}

}  // namespace
}  // namespace ostia::segmentation::detail
