#include "ostia/phantom/heart.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

TEST(Heart, TheFrameIsOrthonormalAndRightHandedForManySeeds) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const HeartShape h = draw_heart(seed);
    EXPECT_NEAR(h.right.norm(), 1.0, 1e-12);
    EXPECT_NEAR(h.long_axis.norm(), 1.0, 1e-12);
    EXPECT_NEAR(h.right.dot(h.long_axis), 0.0, 1e-12);
    EXPECT_NEAR((h.right.cross(h.long_axis) - h.up).norm(), 0.0, 1e-12);
    // The apex lies to the left, in front of and below the base.
    EXPECT_GT(h.long_axis.x(), 0.3);
    EXPECT_LT(h.long_axis.y(), -0.3);
    EXPECT_LT(h.long_axis.z(), -0.3);
  }
}

TEST(Heart, SizesAreThoseOfAdults) {
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const HeartShape h = draw_heart(seed);
    EXPECT_NEAR(h.length_mm, 92.0, 8.01);
    EXPECT_NEAR(h.root.annulus_radius_mm, 12.0, 1.41);
    EXPECT_NEAR(h.root.ascending_radius_mm, 15.0, 2.01);
    EXPECT_GT(h.root.sinus_radius_mm, h.root.annulus_radius_mm);
  }
}

TEST(Heart, PlacesOnTheEpicardiumAreAtDistanceZeroAndOutwardsAtTheirHeight) {
  const HeartShape h = draw_heart(3);
  for (double phi = -3.0; phi < 3.1; phi += 0.5) {
    for (double depth = -0.3; depth < 0.95; depth += 0.2) {
      EXPECT_NEAR(h.epicardial_distance(h.epicardium(phi, depth)), 0.0, 1e-9);
      EXPECT_NEAR(h.epicardial_distance(h.epicardium(phi, depth, 3.0)), 3.0, 0.35);
      EXPECT_NEAR(h.epicardial_distance(h.epicardium(phi, depth, -2.0)), -2.0, 0.2);
      EXPECT_NEAR(h.epicardial_normal(phi, depth).norm(), 1.0, 1e-12);
    }
  }
}

TEST(Heart, TheNormalIsAcrossTheSurface) {
  const HeartShape h = draw_heart(4);
  const double step = 1e-5;
  for (double phi = -3.0; phi < 3.1; phi += 0.7) {
    const Vec3 n = h.epicardial_normal(phi, 0.4);
    const Vec3 around = (h.epicardium(phi + step, 0.4) - h.epicardium(phi - step, 0.4)).normalized();
    const Vec3 down = (h.epicardium(phi, 0.4 + step) - h.epicardium(phi, 0.4 - step)).normalized();
    EXPECT_NEAR(n.dot(around), 0.0, 1e-6);
    EXPECT_NEAR(n.dot(down), 0.0, 1e-6);
  }
}

TEST(Heart, SinusesAreAcrossTheAorticAxis) {
  for (std::uint64_t seed = 1; seed <= 10; ++seed) {
    const AorticRoot root = draw_heart(seed).root;
    EXPECT_NEAR(root.axis.norm(), 1.0, 1e-12);
    EXPECT_NEAR(root.left_sinus.dot(root.axis), 0.0, 1e-12);
    EXPECT_NEAR(root.right_sinus.dot(root.axis), 0.0, 1e-12);
    // About a third of a turn apart.
    EXPECT_NEAR(std::acos(root.left_sinus.dot(root.right_sinus)), 2.0 * M_PI / 3.0, 0.5);
  }
}

TEST(Heart, TheSameSeedGivesTheSameHeart) {
  EXPECT_EQ(draw_heart(5).length_mm, draw_heart(5).length_mm);
  EXPECT_NE(draw_heart(5).length_mm, draw_heart(6).length_mm);
}

}  // namespace
}  // namespace ostia::phantom
