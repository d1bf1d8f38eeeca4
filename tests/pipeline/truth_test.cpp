#include "ostia/pipeline/truth.h"

#include "builtin_model.h"

#include <gtest/gtest.h>

namespace ostia::pipeline {
namespace {

TEST(Truth, BuiltinCaseIsWithinItsBounds) {
  const TruthErrors errors = compare_with_truth(builtin_case(), builtin_model());
  EXPECT_LE(errors.lumen.msd_mm, 0.10);
  EXPECT_LE(errors.axis.radius_median_relative, 0.05);
  EXPECT_LE(errors.throat_relative, 0.15);
  EXPECT_GT(errors.lumen.msd_mm, 0.0);
}

TEST(Truth, SeesAModelThatIsTooWide) {
  Model wide = builtin_model();
  for (auto& p : wide.lumen.points) {
    const auto nearest = geometry::TubeDistance(builtin_case().truth).nearest(p);
    p += 0.5 * (p - nearest.axis_point).normalized();
  }
  const TruthErrors errors = compare_with_truth(builtin_case(), wide);
  EXPECT_NEAR(errors.lumen.signed_mean_mm, 0.5, 0.15);
  EXPECT_GT(errors.lumen.msd_mm, 0.3);
}

}  // namespace
}  // namespace ostia::pipeline
