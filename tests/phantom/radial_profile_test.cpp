#include "ostia/phantom/radial_profile.h"

#include "hand_made_tree.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <vector>

namespace ostia::phantom {
namespace {

using std::numbers::pi;

double ellipse(double a, double b, double theta) {
  return a * b / std::hypot(b * std::cos(theta), a * std::sin(theta));
}

TEST(RadialProfile, ConstantIsExactEverywhere) {
  const RadialProfile profile(0.5, 16, std::vector<double>(10 * 16, 1.7));
  for (double s = -3.0; s < 8.0; s += 0.37) {
    for (double theta = -7.0; theta < 7.0; theta += 0.31) EXPECT_NEAR(profile.at(s, theta), 1.7, 1e-14);
  }
  EXPECT_NEAR(profile.area_at(1.0), pi * 1.7 * 1.7, 1e-12);
  EXPECT_NEAR(profile.mean_at(2.2), 1.7, 1e-13);
  EXPECT_DOUBLE_EQ(profile.length_mm(), 4.5);
}

TEST(RadialProfile, EllipseHasItsAreaAndAxes) {
  const RadialProfile profile =
      testing::profile_of(10.0, [](double, double theta) { return ellipse(2.0, 1.5, theta); });
  EXPECT_NEAR(profile.area_at(4.1), pi * 2.0 * 1.5, 1e-3 * pi * 3.0);
  EXPECT_NEAR(profile.max_at(4.1), 2.0, 1e-9);
  EXPECT_NEAR(profile.min_at(4.1), 1.5, 1e-9);
  for (double theta = 0.0; theta < 6.3; theta += 0.1)
    EXPECT_NEAR(profile.at(5.0, theta), ellipse(2.0, 1.5, theta), 1e-3);
  EXPECT_GE(profile.largest(), 2.0);
  EXPECT_LE(profile.smallest(), 1.5);
}

TEST(RadialProfile, ValueAndSlopeAreContinuousAcrossTheGridAndAroundZero) {
  const RadialProfile profile = testing::profile_of(6.0, [](double s, double theta) {
    return 1.5 + 0.2 * std::sin(3.0 * s) + 0.3 * std::cos(2.0 * theta + s);
  });
  constexpr double h = 1e-6;
  for (const double s : {0.25, 1.0, 2.5, 4.75}) {  // rows
    const double behind = (profile.at(s, 0.4) - profile.at(s - h, 0.4)) / h;
    const double ahead = (profile.at(s + h, 0.4) - profile.at(s, 0.4)) / h;
    EXPECT_NEAR(behind, ahead, 1e-4);
  }
  for (int column = 0; column < 32; ++column) {
    const double theta = 2.0 * pi * column / 32;
    const double behind = (profile.at(1.1, theta) - profile.at(1.1, theta - h)) / h;
    const double ahead = (profile.at(1.1, theta + h) - profile.at(1.1, theta)) / h;
    EXPECT_NEAR(behind, ahead, 1e-4);
  }
  EXPECT_NEAR(profile.at(1.3, 0.5), profile.at(1.3, 0.5 + 2.0 * pi), 1e-12);
  EXPECT_NEAR(profile.at(1.3, -0.5), profile.at(1.3, 2.0 * pi - 0.5), 1e-12);
}

TEST(RadialProfile, BadRadiiAreRefused) {
  EXPECT_THROW(RadialProfile(0.0, 8, std::vector<double>(64, 1.0)), InvalidInput);
  EXPECT_THROW(RadialProfile(0.5, 8, std::vector<double>(63, 1.0)), InvalidInput);
  EXPECT_THROW(RadialProfile(0.5, 8, std::vector<double>(24, 1.0)), InvalidInput);
  std::vector<double> radii(64, 1.0);
  radii[7] = 0.0;
  EXPECT_THROW(RadialProfile(0.5, 8, radii), InvalidInput);
  radii[7] = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(RadialProfile(0.5, 8, radii), InvalidInput);
}

}  // namespace
}  // namespace ostia::phantom
