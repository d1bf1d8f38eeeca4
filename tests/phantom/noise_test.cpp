#include "ostia/phantom/noise.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::phantom {
namespace {

TEST(Noise, UniformHasItsMomentsAndStaysInside) {
  double sum = 0.0, square = 0.0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double u = uniform(7, static_cast<std::uint64_t>(i));
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    sum += u;
    square += u * u;
  }
  EXPECT_NEAR(sum / n, 0.5, 0.003);
  EXPECT_NEAR(square / n, 1.0 / 3.0, 0.003);
}

TEST(Noise, NormalHasItsMomentsAndNeighboursAreIndependent) {
  double sum = 0.0, square = 0.0, product = 0.0, last = 0.0;
  constexpr int n = 200000;
  for (int i = 0; i < n; ++i) {
    const double x = normal(7, static_cast<std::uint64_t>(i));
    sum += x;
    square += x * x;
    product += x * last;
    last = x;
  }
  EXPECT_NEAR(sum / n, 0.0, 0.01);
  EXPECT_NEAR(square / n, 1.0, 0.02);
  EXPECT_NEAR(product / n, 0.0, 0.01);
}

TEST(Noise, DependsOnSeedAndPlaceAlone) {
  EXPECT_EQ(normal(3, 5), normal(3, 5));
  EXPECT_NE(normal(3, 5), normal(4, 5));
  EXPECT_NE(normal(3, 5), normal(3, 6));
}

}  // namespace
}  // namespace ostia::phantom
