#include "ostia/glview/sample_motion.h"

#include "ostia/motion/moving_cage.h"

#include <gtest/gtest.h>

namespace ostia::glview {
namespace {

TEST(SampleMotion, BeatsAsItIsDescribed) {
  const SampleHeart heart = sample_heart(1.2, 3);
  geometry::validate(heart.motion);
  EXPECT_EQ(heart.motion.phases.size(), 20U);
  EXPECT_DOUBLE_EQ(sample_contraction(0.75), 0.0);
  EXPECT_NEAR(sample_contraction(0.38), 1.0, 0.01);
  EXPECT_LT(std::abs(sample_contraction(0.70)), 0.03) << "nearly still";
  EXPECT_NEAR(sample_contraction(1.2), sample_contraction(0.2), 1e-12);
  const motion::MovingCage cage(heart.motion);
  const motion::CarriedPoints carried(heart.motion.grid, heart.surface.points);
  const auto rest = carried.places(cage.at(0.75));
  double off = 0.0, farthest = 0.0;
  const auto systole = carried.places(cage.at(0.4));
  for (std::size_t i = 0; i < rest.size(); ++i) {
    EXPECT_LT((rest[i] - heart.surface.points[i]).norm(), 1e-9);
    off = std::max(off, (systole[i] - sample_place(heart.surface.points[i], 0.4)).norm());
    farthest = std::max(farthest, (systole[i] - rest[i]).norm());
  }
  EXPECT_LT(off, 0.15) << "cells are linear between their corners";
  EXPECT_GT(farthest, 8.0);
  EXPECT_LT(farthest, 20.0);
}

TEST(SampleMotion, HasAboutAsManyPointsAsTheModelsOfThePaper) {
  const SampleHeart heart = sample_heart();
  EXPECT_NEAR(static_cast<double>(heart.surface.points.size()), 10600.0, 600.0);
  EXPECT_EQ(heart.motion.grid.point_count(), 4913U);
}

}  // namespace
}  // namespace ostia::glview
