#include "phantom_pair.h"

#include "ostia/registration/register.h"

#include <gtest/gtest.h>

namespace ostia::registration {
namespace {

TEST(PhantomPair, AxesAndHeartAreCarriedToAMillimetre) {
  phantom_pair::PairOptions options;
  options.voxel_mm = 1.2;
  const phantom_pair::PhantomPair pair(options);
  const Registration found = register_scans(pair.fixed, pair.moving, {pair.axes(), pair.landmarks()});
  EXPECT_LE(pair.mean_error_mm(found.transform, pair.axes()), 1.0);
  EXPECT_LE(pair.mean_error_mm(found.transform, pair.heart_points()), 1.0);
  EXPECT_GT(found.quality.jacobian_min, 0.1);
  EXPECT_EQ(found.quality.verdict, Verdict::good) << found.quality.reason;
}

}  // namespace
}  // namespace ostia::registration
