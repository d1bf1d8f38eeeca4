#include "ostia/experiments/certainty.h"

#include <gtest/gtest.h>

namespace ostia::experiments {
namespace {

TEST(CertaintyOfPatients, OneIsScannedSearchedBothWaysAndJudged) {
  CertaintyOptions options;
  options.patients = 1;
  options.scans = 1;
  options.voxel_mm = 1.0;
  const CertaintyRuns runs = judge_certainty(options);
  EXPECT_EQ(runs.searches, 8U);
  EXPECT_LT(runs.refused, 8U);
  ASSERT_GE(runs.vessels.size(), 10U);
  EXPECT_EQ(runs.first_piece.size(), runs.vessels.size());
  EXPECT_GE(runs.pieces.size(), 2 * runs.vessels.size());
  const evaluation::Calibration vessels = calibration_of(forecasts_of(runs.vessels));
  EXPECT_LT(vessels.expected_error, 0.2);  // of one patient
  EXPECT_LT(vessels.brier, vessels.brier_of_rate + 0.02);
}

}  // namespace
}  // namespace ostia::experiments
