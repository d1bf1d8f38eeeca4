#include "ostia/geometry/contour_set.h"

#include "ostia/geometry/frame.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using ::testing::HasSubstr;

// An ellipse across +z, counter-clockwise looking along +z.
Contour ellipse(double s_mm, double a, double b, int points = 64) {
  const Frame frame{Vec3::UnitZ(), Vec3::UnitX(), Vec3::UnitY()};
  Contour out{s_mm, {}};
  for (int i = 0; i < points; ++i) {
    const Vec3 d = radial_direction(frame, 2.0 * std::numbers::pi * i / points);
    out.points.push_back(Vec3(1.0 + a * d.x(), 2.0 + b * d.y(), s_mm));
  }
  return out;
}

ContourSection section_of(std::vector<Contour> contours) {
  ContourSection out;
  out.contours = std::move(contours);
  return out;
}

TEST(ContourSet, AContourInTheConventionsOrderHasADistalNormal) {
  EXPECT_LT((contour_normal(ellipse(3.0, 2.0, 1.0)) - Vec3::UnitZ()).norm(), 1e-12);
}

TEST(ContourSet, AreaAndCentroidAreThoseOfThePolygon) {
  const Contour c = ellipse(3.0, 2.0, 1.0);
  EXPECT_NEAR(contour_area(c), 2.0 * 64 / 2.0 * std::sin(2.0 * std::numbers::pi / 64), 1e-12);
  EXPECT_LT((contour_centroid(c) - Vec3(1.0, 2.0, 3.0)).norm(), 1e-12);
  Contour l_shape{0.0, {{0, 0, 0}, {2, 0, 0}, {2, 1, 0}, {1, 1, 0}, {1, 3, 0}, {0, 3, 0}}};
  EXPECT_NEAR(contour_area(l_shape), 4.0, 1e-12);
  EXPECT_LT((contour_centroid(l_shape) - Vec3(0.75, 1.25, 0)).norm(), 1e-12);
}

TEST(ContourSet, ASoundSectionHasNoFault) {
  EXPECT_EQ(find_fault(section_of({ellipse(0.0, 2, 1), ellipse(1.0, 2, 1)})), std::nullopt);
}

TEST(ContourSet, EveryFaultIsNamedWithItsPlace) {
  const Contour good = ellipse(0.0, 2, 1);
  EXPECT_THAT(*find_fault(section_of({good})), HasSubstr("1 contours"));
  EXPECT_THAT(*find_fault(section_of({good, ellipse(0.0, 2, 1)})), HasSubstr("does not ascend"));
  Contour few{1.0, {{0, 0, 1}, {1, 0, 1}}};
  EXPECT_THAT(*find_fault(section_of({good, few})), HasSubstr("s_mm 1: it has 2 points"));
  Contour twice = ellipse(1.0, 2, 1);
  twice.points[5] = twice.points[4];
  EXPECT_THAT(*find_fault(section_of({good, twice})), HasSubstr("points 4 and 5 coincide"));
  Contour not_finite = ellipse(1.0, 2, 1);
  not_finite.points[7].x() = NAN;
  EXPECT_THAT(*find_fault(section_of({good, not_finite})), HasSubstr("point 7 is not finite"));
  Contour eight = ellipse(1.0, 2, 1);
  std::swap(eight.points[10], eight.points[40]);
  EXPECT_THAT(*find_fault(section_of({good, eight})), HasSubstr("crosses itself"));
  Contour reversed = ellipse(1.0, 2, 1);
  std::reverse(reversed.points.begin(), reversed.points.end());
  EXPECT_THAT(*find_fault(section_of({good, reversed})), HasSubstr("runs against"));
  Contour flat{1.0, {{0, 0, 1}, {1, 0, 1}, {2, 0, 1}}};
  EXPECT_THAT(*find_fault(section_of({good, flat})), HasSubstr("no area"));
}

}  // namespace
}  // namespace ostia::geometry
