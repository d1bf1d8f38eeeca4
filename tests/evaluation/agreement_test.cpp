#include "ostia/evaluation/agreement.h"

#include "ostia/core/error.h"
#include "ostia/evaluation/motion_error.h"
#include "ostia/evaluation/volume_overlap.h"
#include "ostia/geometry/analytic_shapes.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::evaluation {
namespace {

using geometry::Vec3;

TEST(Agreement, BlandAltmanByHand) {
  const BlandAltman a = bland_altman({1.0, 2.0, 3.0, 4.0}, {1.1, 2.3, 3.1, 4.3});
  EXPECT_EQ(a.count, 4u);
  EXPECT_NEAR(a.bias, 0.2, 1e-12);
  EXPECT_NEAR(a.sd, std::sqrt(4 * 0.01 / 3), 1e-12);
  EXPECT_NEAR(a.upper_limit - a.lower_limit, 2 * 1.96 * a.sd, 1e-12);
  EXPECT_NEAR(a.bias_error, a.sd / 2.0, 1e-12);
  EXPECT_GT(a.correlation, 0.99);
  EXPECT_THROW(bland_altman({1.0}, {1.0}), InvalidInput);
  EXPECT_THROW(bland_altman({1.0, 2.0}, {1.0}), InvalidInput);
  EXPECT_THROW(bland_altman({1.0, std::nan("")}, {1.0, 2.0}), InvalidInput);
}

TEST(Agreement, DetectionCountsEveryPlace) {
  const StenosisDetection d =
      detect_stenoses({{0.6, 0.7}, {0.8, 0.4}, {0.2, 0.55}, {0.0, 0.0}, {0.1, 0.1}}, 0.5);
  EXPECT_EQ(d.true_positive, 1u);
  EXPECT_EQ(d.false_negative, 1u);
  EXPECT_EQ(d.false_positive, 1u);
  EXPECT_EQ(d.true_negative, 2u);
  EXPECT_DOUBLE_EQ(d.sensitivity, 0.5);
  EXPECT_DOUBLE_EQ(d.ppv, 0.5);
  EXPECT_NEAR(d.mean_grade_difference, (0.1 + 0.4 + 0.35) / 5.0, 1e-12);
  EXPECT_TRUE(std::isnan(detect_stenoses({{0.0, 0.0}}).sensitivity));
  EXPECT_THROW(detect_stenoses({}), InvalidInput);
}

TEST(Agreement, WeightedKappaByHand) {
  EXPECT_DOUBLE_EQ(weighted_kappa({{{0, 0}}, {{1, 1}}, {{2, 2}}}, 3), 1.0);
  // Two raters, three categories: observed 1 of 4 off by one, expected sum |a - b| p q.
  const double kappa = weighted_kappa({{{0, 0}}, {{0, 1}}, {{1, 1}}, {{2, 2}}}, 3);
  EXPECT_NEAR(kappa, 1.0 - 1.0 / (0.25 * (2 * (0 + 2 + 2) + 1 * (1 + 0 + 1) + 1 * (2 + 2 + 0))), 1e-12);
  EXPECT_TRUE(std::isnan(weighted_kappa({{{1, 1}}, {{1, 1}}}, 3)));
  EXPECT_THROW(weighted_kappa({{{0, 3}}}, 3), InvalidInput);
}

TEST(VolumeOverlap, ShiftedAndConcentricBalls) {
  const auto ball = [](double radius, const Vec3& shift) {
    geometry::AnalyticShape shape = geometry::straight_tube(0.001, radius);
    geometry::TriMesh mesh = geometry::surface_of(shape, 0.15, false);
    for (Vec3& p : mesh.points) p += shift;
    return mesh;
  };
  const double r = 2.0, d = 1.0;
  const VolumeOverlap v = compare_enclosed(ball(r, Vec3::Zero()), ball(r, Vec3(d, 0, 0)), 0.05);
  const double lens = std::numbers::pi / 12.0 * (4.0 * r + d) * (2.0 * r - d) * (2.0 * r - d);
  const double whole = 4.0 / 3.0 * std::numbers::pi * r * r * r;
  EXPECT_NEAR(v.dice, lens / whole, 0.002);
  EXPECT_NEAR(v.reference_mm3, whole, 0.005 * whole);
  const VolumeOverlap c = compare_enclosed(ball(2.0, Vec3::Zero()), ball(1.0, Vec3::Zero()), 0.05);
  EXPECT_NEAR(c.jaccard, 1.0 / 8.0, 0.002);
  EXPECT_NEAR(c.relative_difference, -7.0 / 8.0, 0.002);
  geometry::TriMesh open = ball(1.0, Vec3::Zero());
  open.triangles.pop_back();
  EXPECT_THROW(compare_enclosed(open, ball(1.0, Vec3::Zero())), InvalidInput);
}

TEST(VolumeOverlap, Masks) {
  imaging::MaskVolume a;
  a.geometry.size = {10, 10, 10};
  a.geometry.spacing = Vec3(0.5, 0.5, 0.5);
  a.voxels.assign(1000, 0);
  imaging::MaskVolume b = a;
  for (std::size_t i = 0; i < 400; ++i) a.voxels[i] = 1;
  for (std::size_t i = 200; i < 600; ++i) b.voxels[i] = 7;
  const VolumeOverlap v = compare_masks(a, b);
  EXPECT_DOUBLE_EQ(v.dice, 0.5);
  EXPECT_DOUBLE_EQ(v.reference_mm3, 50.0);
  b.geometry.origin.x() = 1.0;
  EXPECT_THROW(compare_masks(a, b), InvalidInput);
}

TEST(MotionError, PointByPoint) {
  PointMotion reference{{0.0, 50.0}, {{Vec3::Zero(), Vec3(1, 0, 0)}, {Vec3(0, 0, 4), Vec3(1, 0, 4)}}};
  PointMotion result = reference;
  result.phases[1][0].y() = 3.0;
  const MotionError e = compare_motion(reference, result);
  EXPECT_DOUBLE_EQ(e.phases[0].max_mm, 0.0);
  EXPECT_DOUBLE_EQ(e.phases[1].mean_mm, 1.5);
  EXPECT_DOUBLE_EQ(e.max_mm, 3.0);
  EXPECT_DOUBLE_EQ(e.amplitude_mm, 4.0);
  EXPECT_NEAR(e.rms_mm, std::sqrt(9.0 / 4.0), 1e-12);
  result.phases[1].pop_back();
  EXPECT_THROW(compare_motion(reference, result), InvalidInput);
  result = reference;
  result.percent[1] = 60.0;
  EXPECT_THROW(compare_motion(reference, result), InvalidInput);
  EXPECT_THROW(compare_motion({}, {}), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
