#include "ostia/geometry/zero_crossing.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::geometry {
namespace {

TEST(ZeroCrossing, FindsTheZerosOfFunctionsItDoesNotFit) {
  EXPECT_NEAR(zero_crossing([](double t) { return t * t * t - 0.001; }), 0.1, 1e-12);
  EXPECT_NEAR(zero_crossing([](double t) { return std::exp(9.0 * t) - 2.0; }), std::log(2.0) / 9.0, 1e-12);
  EXPECT_NEAR(zero_crossing([](double t) { return 0.3 - t; }), 0.3, 1e-15);
}

TEST(ZeroCrossing, AJumpIsBracketed) {
  EXPECT_NEAR(zero_crossing([](double t) { return t < 0.7 ? -1.0 : 5.0; }), 0.7, 1e-9);
}

TEST(ZeroCrossing, WithoutAChangeOfSignItIsTheBetterEnd) {
  EXPECT_EQ(zero_crossing([](double t) { return 1.0 + t; }), 0.0);
  EXPECT_EQ(zero_crossing([](double t) { return -2.0 + t; }), 1.0);
}

}  // namespace
}  // namespace ostia::geometry
