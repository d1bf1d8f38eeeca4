// The lumen's outline on a section, of fields that are known by formula.

#include "walls/section_contour.h"

#include "analytic_fields.h"
#include "vessel_trees.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace ostia::analysis {
namespace {

using lumen::testing::FunctionField;
using std::numbers::pi;
using State = SectionContour::State;

geometry::AxisCurve along_z(double length_mm = 40.0) {
  return geometry::AxisCurve(geometry::straight_tube(length_mm, 1.5).tubes.front().axis);
}

/// A circular tube along z that saturates outside as walls from samples do.
FunctionField tube(const Vec2& middle, double radius) {
  return FunctionField([=](const Vec3& p) {
    return std::min(std::hypot(p.x() - middle.x(), p.y() - middle.y()) - radius, 0.25);
  });
}

double farthest_from(const FunctionField& field, const SectionPlane& plane, const std::vector<Vec2>& points) {
  double off = 0.0;
  for (const Vec2& p : points) off = std::max(off, std::abs(field.value(plane.world(p))));
  return off;
}

TEST(SectionContour, OfATubeStartsAtThetaZeroAndRunsCounterClockwise) {
  const auto axis = along_z();
  const FunctionField field = tube({0.3, 0.2}, 1.5);
  const SectionContour contour = section_contour(field, axis, 20.0, 64);
  ASSERT_EQ(contour.state, State::found);
  ASSERT_EQ(contour.points.size(), 64u);
  EXPECT_NEAR(contour.points[0].y(), 0.0, 1e-9);
  EXPECT_GT(contour.points[0].x(), 0.0);
  const ContourMeasures of = measures_of(contour.points);
  EXPECT_NEAR(of.area_mm2, pi * 2.25, 1e-4);  // positive: counter-clockwise
  EXPECT_NEAR(of.largest_width_mm, 3.0, 2e-3);
  const SectionPlane plane(axis, 20.0);
  EXPECT_LE(farthest_from(field, plane, contour.points), 1e-6);
  // Looking distally: y is 90 degrees counter-clockwise from x for one who looks along the tangent.
  EXPECT_NEAR((plane.x.cross(plane.y) + plane.normal).norm(), 0.0, 1e-12);
}

TEST(SectionContour, FollowsTheMiddleWhereTheAxisIsFarOff) {
  const auto axis = along_z();
  const SectionPlane plane(axis, 20.0);
  for (const double off : {1.1, 1.3, 1.45, 1.499}) {
    const Vec3 middle = plane.world(Vec2(0.0, off));
    const FunctionField field = tube({middle.x(), middle.y()}, 1.5);
    const SectionContour contour = section_contour(field, axis, 20.0, 64);
    ASSERT_EQ(contour.state, State::found) << off;
    const ContourMeasures of = measures_of(contour.points);
    EXPECT_NEAR(of.area_mm2, pi * 2.25, 1e-3) << off;
    EXPECT_NEAR((of.centroid - Vec2(0.0, off)).norm(), 0.0, 1e-3);
    EXPECT_NEAR(contour.points[0].y(), 0.0, 1e-4) << off;
    EXPECT_GT(contour.points[0].x(), 0.0);
  }
}

TEST(SectionContour, FindsTheLumenBesideTheAxis) {
  const auto axis = along_z();
  for (const double radius : {1.5, 0.5, 0.08, 0.03}) {
    for (const double gap : {0.05, 0.6, 1.3}) {
      const FunctionField field =
          tube({(radius + gap) * std::cos(2.0), (radius + gap) * std::sin(2.0)}, radius);
      const SectionContour contour = section_contour(field, axis, 11.3, 32);
      ASSERT_EQ(contour.state, State::found) << radius << " " << gap;
      EXPECT_NEAR(measures_of(contour.points).area_mm2, pi * radius * radius, 2e-3 * radius * radius)
          << radius;
    }
  }
}

TEST(SectionContour, OfNearestOfTwoLumensOnly) {
  const FunctionField field([](const Vec3& p) {
    return std::min({std::hypot(p.x() - 1.4, p.y()) - 1.0, std::hypot(p.x() + 2.5, p.y()) - 2.0, 0.25});
  });
  const SectionContour contour = section_contour(field, along_z(), 11.0, 64);
  ASSERT_EQ(contour.state, State::found);
  EXPECT_NEAR(measures_of(contour.points).area_mm2, pi, 1e-3);
}

TEST(SectionContour, SaysWhatIsShutAndWhatIsOpen) {
  const auto axis = along_z();
  EXPECT_EQ(section_contour(tube({0.0, 8.0}, 1.0), axis, 20.0, 64).state, State::shut);
  EXPECT_EQ(section_contour(FunctionField([](const Vec3&) { return 0.25; }), axis, 20.0, 64).state,
            State::shut);
  EXPECT_EQ(
      section_contour(FunctionField([](const Vec3& p) { return std::abs(p.x()) - 1.0; }), axis, 20.0, 64)
          .state,
      State::open);
  EXPECT_EQ(section_contour(tube({0.0, 0.0}, 12.5), axis, 20.0, 64).state, State::open);
  EXPECT_EQ(section_contour(tube({0.0, 0.0}, 11.5), axis, 20.0, 64).state, State::found);
}

TEST(SectionContour, ALumenOfAnotherStretchIsNotThisOnes) {
  // A hairpin: the lumen is shut on the way there and open on the way back, 2.5 mm beside it.
  geometry::Centerline line;
  for (int i = 0; i <= 20; ++i) line.points.emplace_back(0.0, 0.0, i);
  for (int i = 1; i < 12; ++i) {
    const double t = pi * i / 12.0;
    line.points.emplace_back(1.25 - 1.25 * std::cos(t), 0.0, 20.0 + 1.25 * std::sin(t));
  }
  for (int i = 20; i >= 0; --i) line.points.emplace_back(2.5, 0.0, i);
  geometry::complete(line);
  const geometry::AxisCurve axis(line);
  const FunctionField back(
      [](const Vec3& p) { return std::min(std::hypot(p.x() - 2.5, p.y()) - 0.6, 0.25); });
  EXPECT_EQ(section_contour(back, axis, 8.0, 64).state, State::shut);
  EXPECT_EQ(section_contour(back, axis, axis.length() - 8.0, 64).state, State::found);
}

TEST(SectionContour, OfASickleIsFollowedAlongItsWall) {
  // A circle of 2 mm without a circle of 1.5 mm about (0.9, 0): the two walls cross.
  const auto sickle = [](const Vec3& p) {
    return std::max(std::hypot(p.x(), p.y()) - 2.0, 1.5 - std::hypot(p.x() - 0.9, p.y()));
  };
  const double d = 0.9, big = 2.0, small = 1.5;
  const double a = std::acos((d * d + big * big - small * small) / (2.0 * d * big));
  const double b = std::acos((d * d + small * small - big * big) / (2.0 * d * small));
  const double common =
      big * big * (a - std::sin(a) * std::cos(a)) + small * small * (b - std::sin(b) * std::cos(b));
  const double area = pi * big * big - common;
  for (const Vec2& shift : {Vec2(1.6, 0.0), Vec2(-1.05, -1.35)}) {  // the axis in the body, and in a tip
    const FunctionField field([=](const Vec3& p) { return sickle(p - Vec3(shift.x(), shift.y(), 0.0)); });
    const SectionContour contour = section_contour(field, along_z(), 20.0, 64);
    ASSERT_EQ(contour.state, State::found);
    EXPECT_NEAR(measures_of(contour.points).area_mm2, area, 4e-3 * area);
    EXPECT_LE(farthest_from(field, SectionPlane(along_z(), 20.0), contour.points), 1e-5);
  }
}

TEST(SectionContour, OfAFlatLumenHasItsWidths) {
  const FunctionField field([](const Vec3& p) {  // an ellipse of 4 by 0.6 mm
    const double level = std::hypot(p.x() / 2.0, p.y() / 0.3);
    return level < 1e-9 ? -0.3 : (level - 1.0) * level / std::hypot(p.x() / 4.0, p.y() / 0.09);
  });
  const SectionContour contour = section_contour(field, along_z(), 20.0, 64);
  ASSERT_EQ(contour.state, State::found);
  const ContourMeasures of = measures_of(contour.points);
  EXPECT_NEAR(of.area_mm2, pi * 0.6, 5e-3);
  EXPECT_NEAR(of.least_width_mm, 0.6, 2e-3);
  EXPECT_NEAR(of.largest_width_mm, 4.0, 0.02);
}

TEST(SectionContour, AHoleInTheMiddleIsPartOfTheLumen) {
  // What stands within the lumen without touching its wall is not taken off (docs/methods/analysis.md).
  const FunctionField field([](const Vec3& p) {
    return std::max(std::hypot(p.x(), p.y()) - 2.0, 0.5 - std::hypot(p.x() - 0.9, p.y()));
  });
  const SectionContour contour = section_contour(field, along_z(), 20.0, 64);
  ASSERT_EQ(contour.state, State::found);
  EXPECT_NEAR(measures_of(contour.points).area_mm2, pi * 4.0, 0.01);
}

}  // namespace
}  // namespace ostia::analysis
