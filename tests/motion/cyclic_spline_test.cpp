#include "ostia/motion/cyclic_spline.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::motion {
namespace {

using geometry::Vec3;

Vec3 beat(double phase, double shift = 0.0) {
  const double w = 2.0 * std::numbers::pi * phase + shift;
  return {10.0 * std::cos(w), 3.0 * std::sin(2.0 * w), 1.0 + std::sin(w)};
}

CyclicSpline spline_of(const std::vector<double>& phases) {
  std::vector<std::vector<Vec3>> places;
  for (const double phase : phases) places.push_back({beat(phase), beat(phase, 0.7)});
  return {phases, places};
}

std::vector<double> even(int count) {
  std::vector<double> phases;
  for (int k = 0; k < count; ++k) phases.push_back(static_cast<double>(k) / count);
  return phases;
}

double worst(const CyclicSpline& spline) {
  double error = 0.0;
  for (int i = 0; i < 1000; ++i) {
    const double phase = i / 1000.0;
    error = std::max(
        {error, (spline.at(phase)[0] - beat(phase)).norm(), (spline.at(phase)[1] - beat(phase, 0.7)).norm()});
  }
  return error;
}

TEST(CyclicSpline, GoesThroughItsKnots) {
  const std::vector<double> phases = {0.03, 0.1, 0.35, 0.4, 0.75, 0.9};
  const CyclicSpline spline = spline_of(phases);
  for (const double phase : phases)
    for (const double turn : {0.0, 1.0, -3.0})
      EXPECT_NEAR((spline.at(phase + turn)[0] - beat(phase)).norm(), 0.0, 1e-9);
}

TEST(CyclicSpline, ConvergesWithTheFourthPower) {
  EXPECT_LT(worst(spline_of(even(20))), 0.01);
  EXPECT_LT(worst(spline_of(even(40))), worst(spline_of(even(20))) / 12.0);
  EXPECT_LT(worst(spline_of(even(80))), worst(spline_of(even(40))) / 12.0);
}

TEST(CyclicSpline, IsTwiceDifferentiableAcrossTheEndOfTheCycle) {
  for (const double knot : {0.0, 0.1, 0.75}) {
    const CyclicSpline spline = spline_of({0.0, 0.1, 0.35, 0.4, 0.75, 0.9});
    constexpr double h = 1e-6;
    const auto rate = [&](double phase) { return spline.rate(phase)[1]; };
    EXPECT_NEAR((rate(knot + h) - rate(knot - h)).norm(), 0.0, 0.01);
    const Vec3 before = (rate(knot - h) - rate(knot - 2 * h)) / h,
               after = (rate(knot + 2 * h) - rate(knot + h)) / h;
    EXPECT_NEAR((after - before).norm(), 0.0, 1e-3 * (1.0 + before.norm()));
    EXPECT_NEAR(((spline.at(knot + h)[1] - spline.at(knot - h)[1]) / (2 * h) - rate(knot)).norm(), 0.0, 1e-3);
  }
}

TEST(CyclicSpline, APointAtRestStays) {
  const std::vector<Vec3> still = {Vec3(1, 2, 3)};
  const CyclicSpline spline({0.0, 0.2, 0.5}, {still, still, still});
  for (const double phase : {0.1, 0.3, 0.99}) {
    EXPECT_NEAR((spline.at(phase)[0] - still[0]).norm(), 0.0, 1e-12);
    EXPECT_NEAR(spline.rate(phase)[0].norm(), 0.0, 1e-10);
  }
}

TEST(CyclicSpline, RefusesWhatIsNoCycle) {
  const std::vector<Vec3> one = {Vec3::Zero()}, two = {Vec3::Zero(), Vec3::Zero()};
  EXPECT_THROW(CyclicSpline({0.0, 0.5}, {one, one}), InvalidInput);
  EXPECT_THROW(CyclicSpline({0.0, 0.5, 0.5}, {one, one, one}), InvalidInput);
  EXPECT_THROW(CyclicSpline({0.0, 0.5, 1.0}, {one, one, one}), InvalidInput);
  EXPECT_THROW(CyclicSpline({0.0, 0.2, 0.5}, {one, two, one}), InvalidInput);
  EXPECT_THROW(CyclicSpline({0.0, 0.2, 0.5}, {one, one}), InvalidInput);
  EXPECT_THROW(spline_of(even(5)).at(std::nan("")), InvalidInput);
}

}  // namespace
}  // namespace ostia::motion
