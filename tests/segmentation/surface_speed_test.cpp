#include "level_set/surface_speed.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::segmentation::detail {
namespace {

class Ramp : public FeatureForce {  // a feature that grows along x by one a mm
 public:
  Sample at(const Vec3&, const Vec3&) const override { return {3.0, Vec3(1, 0, 0)}; }
};

/// A ring about the z axis: radius `ring` of its axis, `tube` of its section.
imaging::FloatVolume torus(double ring, double tube) {
  imaging::FloatVolume out;
  out.geometry.size = {72, 72, 32};
  out.geometry.spacing = Vec3::Constant(0.4);
  out.geometry.origin = -out.geometry.world(Vec3(35.5, 35.5, 15.5));
  out.voxels.resize(static_cast<std::size_t>(out.geometry.voxels()));
  for (std::int64_t k = 0; k < 32; ++k)
    for (std::int64_t j = 0; j < 72; ++j)
      for (std::int64_t i = 0; i < 72; ++i) {
        const Vec3 p =
            out.geometry.world(Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k)));
        out(i, j, k) = static_cast<float>(std::hypot(std::hypot(p.x(), p.y()) - ring, p.z()) - tube);
      }
  return out;
}

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

TEST(SurfaceSpeed, MinimalCurvatureIsTheSmallerOneOfATorus) {
  // On a torus the curvatures are 1/r and cos(t) / (R + r cos(t)), t about the tube, 0 outermost.
  constexpr double ring = 10.0, tube = 2.0;
  const SparseField field(torus(ring, tube));
  LevelSetOptions options;
  options.advection = 0.0;
  options.curvature = 0.1;
  options.curvature_term = CurvatureTerm::minimal;
  const Ramp ramp;
  const SurfaceSpeed speed(field.geometry(), ramp, nullptr, options);
  double mean = 0.0, squares = 0.0, outer = 0.0, inner = 0.0;
  int outer_count = 0, inner_count = 0;
  for (const std::int64_t n : field.active()) {
    const Vec3 p = field.geometry().world(
        Vec3(static_cast<double>(n % 72), static_cast<double>(n / 72 % 72), static_cast<double>(n / 5184)));
    const double out = std::hypot(p.x(), p.y()) - ring;
    const double cosine = out / std::hypot(out, p.z());
    const double curvature = speed.change(field, n) / (0.4 * 0.1 * 0.16);  // step, w2, h^2
    const double error = curvature - cosine / (ring + tube * cosine);
    mean += error;
    squares += error * error;
    if (cosine > 0.9) outer += curvature, ++outer_count;
    if (cosine < -0.9) inner += curvature, ++inner_count;
  }
  const auto count = static_cast<double>(field.active().size());
  EXPECT_LT(std::abs(mean / count), 0.02);  // the other curvature is 0.5 a mm
  EXPECT_LT(std::sqrt(squares / count), 0.1);
  EXPECT_NEAR(outer / outer_count, 0.97 / (ring + 0.97 * tube), 0.02);
  EXPECT_NEAR(inner / inner_count, -0.97 / (ring - 0.97 * tube), 0.02);
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
