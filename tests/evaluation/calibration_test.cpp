#include "ostia/evaluation/calibration.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::evaluation {
namespace {

/// So many forecasts of one probability, of which so many come.
void add(std::vector<Forecast>& forecasts, double probability, int count, int right) {
  for (int i = 0; i < count; ++i) forecasts.push_back({probability, i < right});
}

TEST(Calibration, WhatComesAsOftenAsWasSaidHasNoError) {
  std::vector<Forecast> forecasts;
  add(forecasts, 0.25, 40, 10);
  add(forecasts, 0.75, 60, 45);
  const Calibration sum = calibration_of(forecasts);
  EXPECT_EQ(sum.count, 100U);
  EXPECT_NEAR(sum.right, 0.55, 1e-12);
  EXPECT_NEAR(sum.expected_error, 0.0, 1e-12);
  EXPECT_NEAR(sum.brier, 0.25 * 0.75, 1e-12);
  EXPECT_NEAR(sum.brier_of_rate, 0.55 * 0.45, 1e-12);
  ASSERT_EQ(sum.bins.size(), 10U);
  EXPECT_EQ(sum.bins[2].count, 40U);
  EXPECT_EQ(sum.bins[7].count, 60U);
  EXPECT_NEAR(sum.bins[7].said, 0.75, 1e-12);
}

TEST(Calibration, TheErrorIsWeighedByCountsAndAFewForecastsAreNoLargestOne) {
  std::vector<Forecast> forecasts;
  add(forecasts, 0.95, 90, 45);  // 0.45 too sure
  add(forecasts, 0.05, 9, 9);    // 0.95 too unsure, but nine of them
  add(forecasts, 1.0, 1, 1);     // in the last bin
  const Calibration sum = calibration_of(forecasts);
  const double last = 91 * ((0.95 * 90 + 1.0) / 91 - 46.0 / 91);
  EXPECT_NEAR(sum.expected_error, (last + 9 * 0.95) / 100, 1e-12);
  EXPECT_NEAR(sum.largest_error, last / 91, 1e-12);
}

TEST(Calibration, RefusesWhatIsNoProbabilityAndSaysNothingOfNothing) {
  EXPECT_EQ(calibration_of({}).expected_error, 0.0);
  EXPECT_THROW(calibration_of({{1.01, true}}), InvalidInput);
  EXPECT_THROW(calibration_of({{-0.01, true}}), InvalidInput);
  EXPECT_THROW(calibration_of({}, 0), InvalidInput);
}

}  // namespace
}  // namespace ostia::evaluation
