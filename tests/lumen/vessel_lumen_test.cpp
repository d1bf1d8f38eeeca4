#include "ostia/lumen/vessel_lumen.h"

#include "tube_samples.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <limits>

namespace ostia::lumen {
namespace {

InterpolationOptions with(double support_radius_mm, double offset_mm) {
  InterpolationOptions options;
  options.support_radius_mm = support_radius_mm;
  options.offset_mm = offset_mm;
  return options;
}

TEST(VesselLumen, OptionsOutOfRangeAreRefused) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_NO_THROW(validate(InterpolationOptions{}));
  EXPECT_NO_THROW(validate(with(50.0, 2.0)));
  for (const InterpolationOptions& bad : {with(0.4, 0.25), with(51.0, 0.25), with(nan, 0.25), with(3.0, 0.0),
                                          with(3.0, 2.1), with(3.0, nan), with(0.5, 0.5)})
    EXPECT_THROW(validate(bad), InvalidInput);
}

TEST(VesselLumen, DefaultSupportRadiusFollowsTheSamplesDensity) {
  const auto axis = testing::straight_axis(40.0);
  const auto radius = [](double, double) { return 1.5; };
  const double coarse = default_support_radius(testing::tube_vessel(axis, radius, 1.0).samples);
  const double fine = default_support_radius(testing::tube_vessel(axis, radius, 0.5).samples);
  EXPECT_GT(coarse, 2.5);
  EXPECT_LT(coarse, 4.0);
  EXPECT_NEAR(fine, 0.5 * coarse, 0.15 * coarse);
}

TEST(VesselLumen, DefaultSupportRadiusNeedsTwoSamples) {
  EXPECT_THROW(default_support_radius({}), InvalidInput);
  EXPECT_THROW(default_support_radius({SurfaceSample{}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::lumen
