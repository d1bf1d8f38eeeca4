#include "mask_kinks.h"

#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <utility>

namespace ostia::coronary {
namespace {

using centerline::Axis;
using geometry::Vec3;

/// Straight along x for 20 mm, then on a circle.
Axis axis_with_bend(double bend_mm, double turn_deg, double radius_mm) {
  Axis axis;
  for (int i = 0; i <= 40; ++i) axis.points.emplace_back(0.5 * i, 0.0, 0.0);
  const double turn = turn_deg * std::numbers::pi / 180.0;
  const int steps = static_cast<int>(std::ceil(bend_mm * turn / 0.3));
  for (int i = 1; i <= steps; ++i) {
    const double angle = turn * i / steps;
    axis.points.emplace_back(20.0 + bend_mm * std::sin(angle), bend_mm * (1.0 - std::cos(angle)), 0.0);
  }
  axis.radius.assign(axis.points.size(), radius_mm);
  return axis;
}

TEST(MaskKinks, AnEndThatTurnsBackGoesAsFarAsItTurns) {
  Axis axis = axis_with_bend(0.8, 230.0, 1.2);
  const double before = geometry::length(axis.points);
  ASSERT_TRUE(trim_hooked_end(axis));
  EXPECT_EQ(axis.points.size(), axis.radius.size());
  EXPECT_LT(geometry::length(axis.points), before - 0.5);
  EXPECT_GT(axis.points.back().x(), 20.0);
  EXPECT_FALSE(trim_hooked_end(axis));  // it turns back no more
}

TEST(MaskKinks, EndsThatBendStay) {
  for (const auto& [bend_mm, turn_deg] : {std::pair{3.0, 120.0}, {6.0, 180.0}, {1.5, 60.0}}) {
    Axis axis = axis_with_bend(bend_mm, turn_deg, 1.2);
    const auto before = axis.points;
    EXPECT_FALSE(trim_hooked_end(axis)) << bend_mm << " mm, " << turn_deg << " degrees";
    EXPECT_EQ(axis.points, before);
  }
  Axis shortest{{Vec3::Zero(), Vec3(1, 0, 0)}, {1.0, 1.0}};
  EXPECT_FALSE(trim_hooked_end(shortest));
}

}  // namespace
}  // namespace ostia::coronary
