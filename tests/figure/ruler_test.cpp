#include "ostia/core/error.h"
#include "ostia/figure/slice_figure.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::figure {
namespace {

reformat::Plane plane_of(const Vec3& u, const Vec3& v) {
  reformat::Plane plane;
  plane.origin = {-31.7, 12.4, 650.2};
  plane.u = u;
  plane.v = v;
  plane.pixel_mm = 0.4;
  plane.width = 250;
  plane.height = 175;
  return plane;
}

/// A tick's place, taken back to the world, has the coordinate that the tick says.
void expect_true_ticks(const reformat::Plane& plane, const Ruler& ruler, bool horizontal, int axis) {
  int major = 0;
  for (const Ruler::Tick& tick : ruler.ticks) {
    const Vec2 at = horizontal ? Vec2(tick.position_px, 0.0) : Vec2(0.0, tick.position_px);
    EXPECT_NEAR(reformat::world(plane, at)[axis], tick.value_mm, 1e-9);
    EXPECT_GE(tick.position_px, -1e-6);
    EXPECT_LE(tick.position_px, (horizontal ? plane.width : plane.height) + 1e-6);
    if (tick.major) ++major;
  }
  EXPECT_GE(major, 3);
}

TEST(Ruler, TicksOfStandardPlanesAreWorldCoordinates) {
  const auto axial = plane_of(Vec3::UnitX(), Vec3::UnitY());
  expect_true_ticks(axial, horizontal_ruler(axial), true, 0);
  expect_true_ticks(axial, vertical_ruler(axial), false, 1);
  EXPECT_EQ(horizontal_ruler(axial).label, "x (mm)");
  EXPECT_EQ(vertical_ruler(axial).label, "y (mm)");
  const auto sagittal = plane_of(Vec3::UnitY(), -Vec3::UnitZ());
  expect_true_ticks(sagittal, vertical_ruler(sagittal), false, 2);
  EXPECT_EQ(vertical_ruler(sagittal).label, "z (mm)");
}

TEST(Ruler, OfAnObliquePlaneCountsFromTheCentre) {
  const Vec3 u = Vec3(1, 0, 1).normalized();
  const auto plane = plane_of(u, Vec3::UnitY());
  const Ruler ruler = horizontal_ruler(plane);
  EXPECT_EQ(ruler.label, "mm from the centre");
  for (const Ruler::Tick& tick : ruler.ticks) {
    EXPECT_NEAR(tick.position_px, 125.0 + tick.value_mm / 0.4, 1e-9);
  }
}

TEST(Ruler, MajorTicksAreRoundAndFiveMinorOnesApart) {
  const auto axial = plane_of(Vec3::UnitX(), Vec3::UnitY());
  const Ruler ruler = horizontal_ruler(axial, 5);  // 100 mm
  for (const Ruler::Tick& tick : ruler.ticks) {
    EXPECT_EQ(tick.major, std::abs(std::remainder(tick.value_mm, 20.0)) < 1e-9) << tick.value_mm;
  }
  EXPECT_NEAR(ruler.ticks[1].value_mm - ruler.ticks[0].value_mm, 4.0, 1e-9);
  EXPECT_THROW(horizontal_ruler(reformat::Plane{}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
