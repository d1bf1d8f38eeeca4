#include "ostia/geometry/axis_curve.h"

#include "ostia/core/error.h"
#include "ostia/geometry/analytic_shapes.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;

AxisCurve helix() {
  return AxisCurve(helix_tube(10.0, 12.0, 2.0, 1.0, 0.1).tubes[0].axis);
}

TEST(AxisCurve, HasTheLengthOfAHelix) {
  const double exact = 2.0 * std::hypot(2.0 * pi * 10.0, 12.0);
  EXPECT_NEAR(helix().length(), exact, 1e-5 * exact);
}

TEST(AxisCurve, IsInArcLengthWithOrthonormalFrames) {
  const AxisCurve axis = helix();
  for (double s = 0.013; s + 1e-4 < axis.length(); s += 0.737) {
    const Vec3 step = axis.point(s + 5e-5) - axis.point(s - 5e-5);
    EXPECT_NEAR(step.norm(), 1e-4, 1e-9);
    const Frame frame = axis.frame(s);
    EXPECT_NEAR(frame.tangent.dot(step.normalized()), 1.0, 1e-10);
    EXPECT_NEAR(frame.tangent.dot(frame.normal), 0.0, 1e-14);
    EXPECT_NEAR(frame.normal.norm(), 1.0, 1e-14);
    EXPECT_NEAR((frame.binormal - frame.tangent.cross(frame.normal)).norm(), 0.0, 1e-14);
  }
}

TEST(AxisCurve, BendsLikeAHelix) {
  const AxisCurve axis = helix();
  const double pitch = 12.0 / (2.0 * pi);
  EXPECT_NEAR(axis.curvature_vector(40.0).norm(), 10.0 / (100.0 + pitch * pitch), 1e-4);
}

TEST(AxisCurve, FindsTheFootOfAPlaceBesideIt) {
  const AxisCurve axis = helix();
  for (double s = 3.0; s < axis.length() - 3.0; s += 2.31) {
    for (double theta : {-3.0, -1.0, 0.0, 0.7, 2.9}) {
      const AxisFoot foot = axis.nearest_foot(axis.place(s, theta, 2.0));
      EXPECT_NEAR(foot.s_mm, s, 1e-8);
      EXPECT_NEAR(foot.theta, theta, 1e-8);
      EXPECT_NEAR(foot.rho_mm, 2.0, 1e-9);
      EXPECT_FALSE(foot.past_end);
    }
  }
}

TEST(AxisCurve, FindsBothSidesOfABend) {
  // Half a circle of radius 5 with straight legs: the centre of the bend is as far from everything.
  Centerline line;
  for (double y = -10.0; y < 0.0; y += 0.1) line.points.push_back({5.0, y, 0.0});
  for (int i = 0; i <= 100; ++i) {
    const double a = pi * i / 100.0;
    line.points.push_back({5.0 * std::cos(a), 5.0 * std::sin(a), 0.0});
  }
  for (double y = -0.1; y > -10.0; y -= 0.1) line.points.push_back({-5.0, y, 0.0});
  const AxisCurve axis(line);
  const auto feet = axis.feet({1.0, -5.0, 0.0}, 20.0);
  ASSERT_GE(feet.size(), 2U);
  EXPECT_NEAR(feet[0].rho_mm, 4.0, 1e-6);
  EXPECT_NEAR(feet[0].s_mm, 5.0, 1e-6);
  EXPECT_NEAR(feet[1].rho_mm, 6.0, 1e-6);
  const auto far_side = axis.foot_near({1.0, -5.0, 0.0}, feet[1].s_mm + 0.5, 2.0);
  ASSERT_TRUE(far_side);
  EXPECT_NEAR(far_side->rho_mm, 6.0, 1e-6);
  EXPECT_FALSE(axis.foot_near({1.0, -5.0, 0.0}, 12.0, 1.0));
}

TEST(AxisCurve, KnowsWhatLiesBeyondItsEnds) {
  const AxisCurve axis(straight_tube(20.0, 1.5).tubes[0].axis);
  const AxisFoot before = axis.nearest_foot({0.3, 0.0, -2.0});
  EXPECT_TRUE(before.past_end);
  EXPECT_EQ(before.s_mm, 0.0);
  const AxisFoot behind = axis.nearest_foot({0.0, 0.4, 21.0});
  EXPECT_TRUE(behind.past_end);
  EXPECT_NEAR(behind.s_mm, 20.0, 1e-9);
  EXPECT_NEAR(axis.nearest_foot({1.0, 0.0, 20.0}).rho_mm, 1.0, 1e-9);
}

TEST(AxisCurve, ReadsTheRadiusBetweenThePoints) {
  const AxisCurve axis(tapered_tube(20.0, 2.0, 1.0).tubes[0].axis);
  EXPECT_NEAR(axis.radius(10.0), 1.5, 1e-9);
  EXPECT_NEAR(axis.radius(-1.0), 2.0, 1e-12);
  EXPECT_NEAR(axis.radius(99.0), 1.0, 1e-12);
}

TEST(AxisCurve, KeepsTheFirstNormalOfItsLine) {
  Centerline line = straight_tube(10.0, 1.0).tubes[0].axis;
  complete(line, Vec3(0.0, 1.0, 0.0));
  EXPECT_NEAR(AxisCurve(line).frame(5.0).normal.y(), 1.0, 1e-12);
}

TEST(AxisCurve, SampledAgainIsItself) {
  const AxisCurve axis = helix();
  const Centerline line = axis.sampled(0.2);
  ASSERT_EQ(line.frames.size(), line.points.size());
  const AxisCurve again(line);
  EXPECT_NEAR(again.length(), axis.length(), 1e-4);
  EXPECT_LT((again.point(33.3) - axis.point(33.3)).norm(), 1e-4);
  EXPECT_LT((again.frame(33.3).normal - axis.frame(33.3).normal).norm(), 1e-3);
}

TEST(AxisCurve, RefusesWhatIsNoAxis) {
  Centerline line;
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
  line.points = {Vec3(1, 2, 3), Vec3(1, 2, 3)};
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
  line.points = {Vec3(0, 0, 0), Vec3(0, 0, std::nan(""))};
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
  line.points = {Vec3(0, 0, 0), Vec3(0, 0, 5)};
  line.radius = {1.0};
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
  line.radius = {1.0, -1.0};
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
  line.points[1].z() = 2e4;
  line.radius.clear();
  EXPECT_THROW(AxisCurve{line}, InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
