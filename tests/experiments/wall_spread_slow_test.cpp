// How often the true calibre of a phantom's section lies within the interval that its image lets expect.

#include "ostia/experiments/wall_spread.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::experiments {
namespace {

/// The model's scale was chosen on the seeds 1 to 500; none of them is here.
TEST(WallSpreadInFull, HoldsTheTruthInNinetyFiveOfAHundredSections) {
  WallSpreadOptions options;
  options.first_seed = 20001;
  options.vessels = 100;
  options.sections = 2;
  const SpreadRun run = run_wall_spread(options);
  ASSERT_EQ(run.sections.size(), 200u);
  const auto groups = coverage(run.sections);
  EXPECT_GE(groups[0].held, 0.93);
  EXPECT_LE(groups[0].held, 0.97);
  EXPECT_LT(std::abs(groups[0].bias_mm), 0.02);
  EXPECT_GE(groups[2].sections, 100u);
  EXPECT_GE(groups[2].held, 0.90);
  EXPECT_GT(groups[2].sd_mm, groups[1].sd_mm);
}

}  // namespace
}  // namespace ostia::experiments
