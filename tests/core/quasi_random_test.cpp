// Evenly spread points and normal numbers: against closed forms.

#include "ostia/core/quasi_random.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace ostia::core {
namespace {

TEST(QuasiRandom, QuantilesOfTheNormalDistributionAreExact) {
  // 0.5 erfc(-x / sqrt 2) is the distribution function.
  for (const double p : {1e-300, 1e-20, 1e-9, 1e-4, 0.025, 0.07, 0.3, 0.5, 0.62, 0.93, 0.975, 0.9999}) {
    const double x = normal_quantile(p);
    EXPECT_NEAR(0.5 * std::erfc(-x / std::numbers::sqrt2) / p, 1.0, 1e-11) << p;
    if (p > 1e-12) {
      EXPECT_NEAR(normal_quantile(1.0 - p), -x, 1e-6 * std::abs(x) + 1e-12) << p;
    }
  }
  EXPECT_NEAR(normal_quantile(0.975), 1.959963984540054, 1e-14);
  EXPECT_THROW(normal_quantile(0.0), InvalidInput);
  EXPECT_THROW(normal_quantile(1.0), InvalidInput);
  EXPECT_THROW(normal_quantile(std::nan("")), InvalidInput);
}

/// As Halton's: of the first b^k points one lies in each interval of length b^-k.
TEST(QuasiRandom, EveryIntervalHoldsItsShare) {
  const ScrambledHalton points(5, 17);
  const std::size_t bases[] = {2, 3, 5, 7, 11};
  for (std::size_t d = 0; d < points.dimensions(); ++d) {
    const std::size_t count = bases[d] * bases[d];
    std::set<int> met;
    for (std::size_t i = 0; i < count; ++i) {
      const double x = points.at(i, d);
      EXPECT_GT(x, 0.0);
      EXPECT_LT(x, 1.0);
      met.insert(static_cast<int>(x * static_cast<double>(count)));
    }
    EXPECT_EQ(met.size(), count) << d;
  }
}

/// The mean of a product of 12 factors, whose value is 1, by 4,096 points; chance would miss it by 0.017.
TEST(QuasiRandom, IntegratesBetterThanChance) {
  double squares = 0.0;
  constexpr int seeds = 10, count = 4096;
  for (std::uint64_t seed = 0; seed < seeds; ++seed) {
    const ScrambledHalton points(12, seed);
    double sum = 0.0;
    for (std::uint64_t i = 0; i < count; ++i) {
      double product = 1.0;
      for (std::size_t d = 0; d < 12; ++d) product *= 1.0 + (points.at(i, d) - 0.5);
      sum += product / count;
    }
    squares += (sum - 1.0) * (sum - 1.0) / seeds;
  }
  EXPECT_LT(std::sqrt(squares), 0.006);
  EXPECT_NE(ScrambledHalton(1, 1).at(3, 0), ScrambledHalton(1, 2).at(3, 0));  // each seed has its own points
  EXPECT_NE(ScrambledHalton(2, 1).at(1, 1), 1.0 / 3.0);                       // and none has Halton's
}

TEST(QuasiRandom, NormalNumbersHaveTheirMoments) {
  std::vector<double> numbers(200000);
  fill_normal_numbers(5, numbers);
  double mean = 0.0, square = 0.0, fourth = 0.0, beside = 0.0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const double x = numbers[i];
    mean += x, square += x * x, fourth += x * x * x * x;
    if (i > 0) beside += x * numbers[i - 1];
  }
  const auto n = static_cast<double>(numbers.size());
  EXPECT_NEAR(mean / n, 0.0, 0.01);
  EXPECT_NEAR(square / n, 1.0, 0.015);
  EXPECT_NEAR(fourth / n, 3.0, 0.1);
  EXPECT_NEAR(beside / n, 0.0, 0.01);
  std::vector<double> again(100);
  fill_normal_numbers(5, again);
  EXPECT_TRUE(std::equal(again.begin(), again.end(), numbers.begin()));
  fill_normal_numbers(6, again);
  EXPECT_NE(again.front(), numbers.front());
}

TEST(QuasiRandom, RefusesNoDimension) {
  EXPECT_THROW(ScrambledHalton(0, 1), InvalidInput);
  EXPECT_THROW(ScrambledHalton(1001, 1), InvalidInput);
}

}  // namespace
}  // namespace ostia::core
