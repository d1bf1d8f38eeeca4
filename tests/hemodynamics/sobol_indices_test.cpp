// Shares of a variance, against functions whose shares are known in closed form.

#include "ostia/hemodynamics/sobol_indices.h"

#include "ostia/core/error.h"
#include "ostia/core/quasi_random.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <vector>

namespace ostia::hemodynamics {
namespace {

using Point = std::array<double, 3>;
using Function = std::function<double(const Point&)>;

std::array<SobolIndex, 3> indices_of(const Function& f, std::size_t rows, std::uint64_t seed) {
  const core::ScrambledHalton points(6, seed);
  std::vector<double> a(rows), b(rows);
  std::array<std::vector<double>, 3> mixed;
  for (auto& one : mixed) one.resize(rows);
  for (std::size_t i = 0; i < rows; ++i) {
    Point pa, pb;
    for (std::size_t d = 0; d < 3; ++d) pa[d] = points.at(i, 2 * d), pb[d] = points.at(i, 2 * d + 1);
    a[i] = f(pa), b[i] = f(pb);
    for (std::size_t d = 0; d < 3; ++d) {
      Point p = pa;
      p[d] = pb[d];
      mixed[d][i] = f(p);
    }
  }
  std::array<SobolIndex, 3> out;
  for (std::size_t d = 0; d < 3; ++d) out[d] = sobol_index(a, b, mixed[d]);
  return out;
}

/// Ishigami and Homma 1990 with a = 7 and b = 0.1.
TEST(SobolIndices, MeetsIshigamisFunction) {
  constexpr double pi = std::numbers::pi, a = 7.0, b = 0.1;
  const double first = 0.5 * std::pow(1.0 + b * std::pow(pi, 4) / 5.0, 2), second = a * a / 8.0,
               together = b * b * std::pow(pi, 8) * (1.0 / 18.0 - 1.0 / 50.0);
  const double variance = first + second + together;
  const Function f = [](const Point& u) {
    std::array<double, 3> x;
    for (std::size_t d = 0; d < 3; ++d) x[d] = pi * (2.0 * u[d] - 1.0);
    return std::sin(x[0]) + a * std::pow(std::sin(x[1]), 2) + b * std::pow(x[2], 4) * std::sin(x[0]);
  };
  const auto found = indices_of(f, 8192, 3);
  EXPECT_NEAR(found[0].first, first / variance, 0.015);
  EXPECT_NEAR(found[1].first, second / variance, 0.015);
  EXPECT_NEAR(found[2].first, 0.0, 0.015);
  EXPECT_NEAR(found[0].total, (first + together) / variance, 0.015);
  EXPECT_NEAR(found[1].total, second / variance, 0.015);
  EXPECT_NEAR(found[2].total, together / variance, 0.015);
}

TEST(SobolIndices, AddUpWhereNothingActsTogether) {
  const Function f = [](const Point& u) { return 3.0 * u[0] + 2.0 * u[1] + u[2]; };
  const auto found = indices_of(f, 1024, 5);
  const std::array<double, 3> shares = {9.0 / 14.0, 4.0 / 14.0, 1.0 / 14.0};
  for (std::size_t d = 0; d < 3; ++d) {
    EXPECT_NEAR(found[d].first, shares[d], 0.02) << d;
    EXPECT_NEAR(found[d].total, shares[d], 0.02) << d;
  }
}

/// 500 rows are what 1,000 trees give: the error of a share is some hundredths.
TEST(SobolIndices, IsOffByHundredthsOnFiveHundredRows) {
  const Function f = [](const Point& u) { return 4.0 * u[0] + u[1] + 0.3 * u[2]; };
  const double variance = 16.0 + 1.0 + 0.09;
  double square = 0.0;
  for (std::uint64_t seed = 0; seed < 20; ++seed) {
    const auto found = indices_of(f, 500, seed);
    square += std::pow(found[0].first - 16.0 / variance, 2) / 40.0;
    square += std::pow(found[2].first - 0.09 / variance, 2) / 40.0;
  }
  EXPECT_LT(std::sqrt(square), 0.02);
}

TEST(SobolIndices, LeavesOutWhatIsNoNumberAndWhatDoesNotVary) {
  const std::vector<double> flat(10, 0.7);
  EXPECT_EQ(sobol_index(flat, flat, flat).total, 0.0);
  EXPECT_EQ(sobol_index(flat, flat, flat).first, 0.0);
  std::vector<double> a = {1.0, 2.0, 3.0, 4.0}, b = {2.0, 1.0, 4.0, 3.0}, mixed = b;
  const SobolIndex whole = sobol_index(a, b, mixed);
  for (auto* one : {&a, &b, &mixed}) one->push_back(5.0);
  mixed.back() = std::numeric_limits<double>::quiet_NaN();
  const SobolIndex again = sobol_index(a, b, mixed);
  EXPECT_EQ(again.first, whole.first);
  EXPECT_EQ(again.total, whole.total);
  EXPECT_THROW(sobol_index(a, b, std::vector<double>{1.0}), InvalidInput);
}

}  // namespace
}  // namespace ostia::hemodynamics
