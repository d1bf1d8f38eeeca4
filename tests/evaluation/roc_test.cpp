#include "ostia/evaluation/roc.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::evaluation {
namespace {

/// By hand: 8 of 9 pairs are in order; placements 2/3, 1, 1 on both sides, of variance 1/27.
TEST(RocCurves, AreaAndItsErrorAreThoseByHand) {
  const Roc found = roc({3.0, 4.0, 5.0, 1.0, 2.0, 3.5}, {true, true, true, false, false, false});
  EXPECT_EQ(found.positive, 3u);
  EXPECT_EQ(found.negative, 3u);
  EXPECT_DOUBLE_EQ(found.area, 8.0 / 9.0);
  EXPECT_NEAR(found.area_error, std::sqrt(2.0 / 27.0 / 3.0), 1e-12);
  EXPECT_NEAR(found.area_interval[0], 8.0 / 9.0 - 1.959964 * 0.1571348, 1e-6);
  EXPECT_DOUBLE_EQ(found.area_interval[1], 1.0);
}

TEST(RocCurves, GoFromTheStrictestThresholdToTheLaxest) {
  const Roc found = roc({3.0, 4.0, 5.0, 1.0, 2.0, 3.5}, {true, true, true, false, false, false});
  ASSERT_EQ(found.curve.size(), 6u);
  EXPECT_DOUBLE_EQ(found.curve[0].threshold, 5.0);
  EXPECT_DOUBLE_EQ(found.curve[0].sensitivity, 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(found.curve[0].specificity, 1.0);
  EXPECT_DOUBLE_EQ(found.curve[2].threshold, 3.5);
  EXPECT_DOUBLE_EQ(found.curve[2].specificity, 2.0 / 3.0);
  EXPECT_DOUBLE_EQ(found.curve.back().sensitivity, 1.0);
  EXPECT_DOUBLE_EQ(found.curve.back().specificity, 0.0);
  EXPECT_DOUBLE_EQ(found.best.threshold, 4.0);  // 2/3 and 1; 3.0 gives as much, and is laxer
}

TEST(RocCurves, TiesCountHalfAndChanceIsHalf) {
  const Roc all_alike = roc({1.0, 1.0, 1.0, 1.0}, {true, false, true, false});
  EXPECT_DOUBLE_EQ(all_alike.area, 0.5);
  EXPECT_EQ(all_alike.curve.size(), 1u);
  EXPECT_DOUBLE_EQ(roc({2.0, 1.0, 1.0}, {true, true, false}).area, 0.75);
}

/// 8 of 10: 0.490 to 0.943 (Wilson, as Brown, Cai and DasGupta 2001 compute it).
TEST(RocCurves, WilsonsIntervalIsThePublishedOne) {
  const Interval found = wilson_interval(8, 10);
  EXPECT_NEAR(found[0], 0.4902, 5e-5);
  EXPECT_NEAR(found[1], 0.9433, 5e-5);
  EXPECT_NEAR(wilson_interval(0, 10)[1], 0.2775, 5e-5);
  EXPECT_DOUBLE_EQ(wilson_interval(0, 10)[0], 0.0);
}

TEST(RocCurves, WhatIsNoneIsRefused) {
  EXPECT_THROW(roc({1.0, 2.0}, {true}), InvalidInput);
  EXPECT_THROW(roc({1.0, 2.0}, {true, true}), InvalidInput);
  EXPECT_THROW(roc({1.0, 2.0}, {false, false}), InvalidInput);
  EXPECT_THROW(roc({1.0, std::nan("")}, {true, false}), InvalidInput);
  EXPECT_THROW(wilson_interval(0, 0), InvalidInput);
  EXPECT_TRUE(std::isnan(roc({1.0, 2.0}, {true, false}).area_error));
}

}  // namespace
}  // namespace ostia::evaluation
