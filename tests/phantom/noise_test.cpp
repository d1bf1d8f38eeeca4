#include "ostia/phantom/noise.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <vector>

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

TEST(Noise, FilledNormalsFollowTheDistributionToItsTails) {
  std::vector<float> values(2000000);
  fill_normal(11, 5, values);
  double sum = 0.0, square = 0.0, fourth = 0.0, product = 0.0;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const double x = values[i];
    sum += x;
    square += x * x;
    fourth += x * x * x * x;
    if (i > 0) product += x * values[i - 1];
  }
  const auto n = static_cast<double>(values.size());
  EXPECT_NEAR(sum / n, 0.0, 0.003);
  EXPECT_NEAR(square / n, 1.0, 0.004);
  EXPECT_NEAR(fourth / n, 3.0, 0.03);
  EXPECT_NEAR(product / n, 0.0, 0.003);
  // Kolmogorov and Smirnov: the largest gap to the distribution function, of which 1.63 / sqrt(n) is exceeded
  // in one of a hundred.
  std::sort(values.begin(), values.end());
  double gap = 0.0;
  for (std::size_t i = 0; i < values.size(); i += 7) {
    const double expected = 0.5 * std::erfc(-values[i] / std::numbers::sqrt2);
    gap = std::max(gap, std::abs(expected - static_cast<double>(i) / n));
  }
  EXPECT_LT(gap, 1.63 / std::sqrt(n));
  const auto beyond_four =
      std::count_if(values.begin(), values.end(), [](float x) { return std::abs(x) > 4.0f; });
  EXPECT_NEAR(static_cast<double>(beyond_four), 6.33e-5 * n, 40.0);
  EXPECT_GT(values.back(), 4.6f);
  EXPECT_LT(values.back(), 6.5f);
}

TEST(Noise, FilledNormalsDependOnSeedAndPlaceAlone) {
  std::vector<float> whole(100), part(50);
  fill_normal(3, 1000, whole);
  fill_normal(3, 1031, part);
  for (std::size_t i = 0; i < part.size(); ++i) EXPECT_EQ(part[i], whole[i + 31]);
  fill_normal(4, 1031, part);
  EXPECT_NE(part[0], whole[31]);
}

}  // namespace
}  // namespace ostia::phantom
