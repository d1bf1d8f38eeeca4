#include "ostia/phantom/heart_warp.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

/// A grid of places 40 mm apart.
std::vector<Vec3> grid() {
  std::vector<Vec3> out;
  for (int i = -3; i <= 3; ++i)
    for (int j = -2; j <= 2; ++j)
      for (int k = -3; k <= 3; ++k) out.emplace_back(40.0 * i, 40.0 * j, 40.0 * k);
  return out;
}

TEST(HeartWarp, OfLandmarksThatStayItIsTheIdentity) {
  WarpLandmarks marks;
  for (const Vec3& p : grid()) marks.add(p, p);
  const HeartWarp warp(marks);
  EXPECT_NEAR(warp.least_jacobian(), 1.0, 1e-9);
  EXPECT_NEAR(warp.largest_jacobian(), 1.0, 1e-9);
  EXPECT_NEAR(warp.longest_mm(), 0.0, 1e-9);
  EXPECT_EQ(warp.smoothings(), 0);
}

TEST(HeartWarp, BringsLandmarksWhereTheyBelongAndBackAgain) {
  WarpLandmarks marks;
  for (const Vec3& p : grid()) {
    const double near = std::exp(-p.squaredNorm() / (2.0 * 60.0 * 60.0));
    marks.add(p, p + near * Vec3(6.0, -4.0, 5.0));
  }
  const HeartWarp warp(marks);
  for (std::size_t i = 0; i < marks.world.size(); i += 7) {
    if (marks.world[i].norm() > 110.0) continue;  // it fades towards its border
    EXPECT_LT((warp.to_own(marks.world[i]) - marks.own[i]).norm(), 0.15) << i;
    EXPECT_LT((warp.to_world(warp.to_own(marks.world[i])) - marks.world[i]).norm(), 1e-6);
  }
  EXPECT_EQ(warp.to_own(Vec3(500, 0, 0)), Vec3(500, 0, 0));
}

TEST(HeartWarp, ItsGradientIsThatOfItsPlaces) {
  WarpLandmarks marks;
  for (const Vec3& p : grid())
    marks.add(p, p + 5.0 * Vec3(std::sin(p.y() / 50.0), std::sin(p.z() / 60.0), std::cos(p.x() / 70.0)));
  const HeartWarp warp(marks);
  constexpr double h = 1e-4;
  for (const Vec3& p : {Vec3(3, 4, 5), Vec3(-31, 22, 47), Vec3(60, -35, -71)}) {
    Mat3 expected;
    for (int axis = 0; axis < 3; ++axis)
      expected.col(axis) =
          (warp.to_own(p + h * Vec3::Unit(axis)) - warp.to_own(p - h * Vec3::Unit(axis))) / (2.0 * h);
    EXPECT_LT((warp.gradient(p) - expected).cwiseAbs().maxCoeff(), 1e-6);
  }
}

TEST(HeartWarp, WhatWouldFoldIsSmoothedUntilItDoesNot) {
  WarpLandmarks marks;
  for (const Vec3& p : grid()) marks.add(p, p);
  // Two places change sides.
  marks.add({-5, 3, 0}, {9, 3, 0});
  marks.add({5, 3, 0}, {-9, 3, 0});
  const HeartWarp warp(marks);
  EXPECT_GT(warp.smoothings(), 0);
  EXPECT_GE(warp.least_jacobian(), 0.25);
  double least = 1.0;
  for (double x = -40.0; x <= 40.0; x += 1.7)
    for (double y = -30.0; y <= 30.0; y += 1.9)
      for (double z = -30.0; z <= 30.0; z += 2.1)
        least = std::min(least, warp.gradient({x, y, z}).determinant());
  EXPECT_GT(least, 0.2) << "between the places that were looked at";
  EXPECT_THROW(HeartWarp(WarpLandmarks{{Vec3::Zero()}, {Vec3::Zero()}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
