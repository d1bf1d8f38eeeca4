#include "ostia/solver/womersley.h"

#include "solver_test_support.h"

namespace ostia::solver {
namespace {

using Complex = std::complex<double>;

Complex bessel(int order, double x) {
  return scaled_bessel(order, x) * std::exp(x / std::numbers::sqrt2);
}

TEST(Womersley, BesselFunctionsAreThePublishedKelvinFunctions) {
  // ber x + i bei x = J0(i^(3/2) x): Abramowitz and Stegun, table 9.12; ber_1 + i bei_1 likewise.
  EXPECT_NEAR(std::abs(bessel(0, 1.0) - Complex(0.9843817812, 0.2495660400)), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(bessel(0, 5.0) - Complex(-6.2300824787, 0.1160343816)), 0.0, 1e-9);
  EXPECT_NEAR(std::abs(bessel(1, 1.0) - Complex(-0.3958682610, 0.3075566314)), 0.0, 1e-9);
}

TEST(Womersley, SeriesAndAsymptoticsMeet) {
  for (const int order : {0, 1}) {
    // Both sides of the change differ by the function's own slope alone.
    const Complex before = scaled_bessel(order, 25.0), behind = scaled_bessel(order, 25.0 + 1e-9);
    EXPECT_LT(std::abs(behind - before) / std::abs(before), 5e-9);
  }
}

TEST(Womersley, ProfileSolvesTheEquationOfMotion) {
  // u'' + u'/s - i alpha^2 u is the pressure gradient, the same everywhere.
  for (const double alpha : {0.5, 3.0, 12.0, 40.0}) {
    constexpr double h = 1e-4;
    const auto forcing = [&](double s) {
      const Complex a = womersley_profile(alpha, s - h), b = womersley_profile(alpha, s),
                    c = womersley_profile(alpha, s + h);
      return (a - 2.0 * b + c) / (h * h) + (c - a) / (2.0 * h * s) - Complex(0.0, alpha * alpha) * b;
    };
    const Complex middle = forcing(0.3);
    for (const double s : {0.1, 0.6, 0.9, 0.98})
      EXPECT_LT(std::abs(forcing(s) - middle), 2e-4 * std::abs(middle)) << alpha << ' ' << s;
    EXPECT_LT(std::abs(womersley_profile(alpha, 1.0)), 1e-10);
  }
}

TEST(Womersley, MeanOverTheSectionIsOne) {
  for (const double alpha : {0.0, 1e-4, 0.01, 2.0, 10.0, 24.9, 25.1, 74.0, 300.0}) {
    Complex mean = 0.0;
    constexpr int n = 40000;
    for (int i = 0; i < n; ++i) {
      const double s = (i + 0.5) / n;
      mean += womersley_profile(alpha, s) * 2.0 * s / static_cast<double>(n);
    }
    EXPECT_LT(std::abs(mean - 1.0), 1e-6) << alpha;
  }
}

TEST(Womersley, SlowFlowIsAParabolaAndFastFlowIsFlat) {
  for (const double s : {0.0, 0.3, 0.8, 1.0}) {
    EXPECT_LT(std::abs(womersley_profile(0.02, s) - 2.0 * (1.0 - s * s)), 1e-4);
    EXPECT_LT(std::abs(womersley_profile(0.0009, s) - womersley_profile(0.0011, s)), 1e-6);
  }
  EXPECT_NEAR(std::abs(womersley_profile(200.0, 0.0)), 1.0, 0.01);
  EXPECT_NEAR(std::abs(womersley_profile(200.0, 0.9)), 1.0, 0.01);
}

TEST(Womersley, RefusesWhatIsNoRadius) {
  expect_refusal([] { womersley_profile(1.0, 1.1); }, {"radius"});
  expect_refusal([] { womersley_profile(-1.0, 0.5); }, {"alpha"});
  EXPECT_NEAR(womersley_number(2.0, 2.0 * std::numbers::pi, 3.3),
              2.0 * std::sqrt(2.0 * std::numbers::pi / 3.3), 1e-12);
}

}  // namespace
}  // namespace ostia::solver
