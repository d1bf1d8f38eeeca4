#include "ostia/geometry/line_geometry.h"

#include "ostia/core/error.h"
#include "ostia/geometry/line_place.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

std::vector<Vec3> any_normals(std::size_t count) {
  return std::vector<Vec3>(count, Vec3::UnitX());
}

TEST(LineGeometry, AHelixHasTheCurvatureTorsionAndFramesOfAHelix) {
  constexpr double a = 5.0, b = 1.5;  // radius, rise per radian
  std::vector<Vec3> points;
  for (int i = 0; i <= 800; ++i) {
    const double u = 0.01 * i;
    points.emplace_back(a * std::cos(u), a * std::sin(u), b * u);
  }
  const LineGeometry bends = line_geometry(points, any_normals(points.size()));
  for (std::size_t i = 5; i + 5 < points.size(); ++i) {
    const double u = 0.01 * static_cast<double>(i), c = std::hypot(a, b);
    EXPECT_NEAR(bends.curvature[i], a / (c * c), 1e-5);
    EXPECT_NEAR(bends.torsion[i], b / (c * c), 1e-5);  // a right-handed one is positive
    EXPECT_NEAR((bends.normal[i] - Vec3(-std::cos(u), -std::sin(u), 0)).norm(), 0.0, 1e-5);
    EXPECT_NEAR((bends.tangent[i] - Vec3(-a * std::sin(u), a * std::cos(u), b) / c).norm(), 0.0, 1e-5);
    EXPECT_NEAR((bends.binormal[i] - bends.tangent[i].cross(bends.normal[i])).norm(), 0.0, 1e-12);
  }
  EXPECT_EQ(bends.curvature.front(), 0.0);
}

TEST(LineGeometry, AnArcOfATorusHasItsRingsCurvatureAndNoTorsion) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 90; ++i) {
    const double u = i * std::numbers::pi / 180.0;
    points.emplace_back(12.0 * std::cos(u), 12.0 * std::sin(u), 0.0);
  }
  const LineGeometry bends = line_geometry(points, any_normals(points.size()));
  for (std::size_t i = 2; i + 2 < points.size(); ++i) {
    EXPECT_NEAR(bends.curvature[i], 1.0 / 12.0, 1e-5);
    EXPECT_NEAR(bends.torsion[i], 0.0, 1e-12);
  }
  EXPECT_NEAR(tortuosity(points), 0.5 * std::numbers::pi / std::sqrt(2.0) - 1.0, 1e-4);
}

TEST(LineGeometry, AStraightLineTakesTheNormalsItIsGiven) {
  const std::vector<Vec3> points{{0, 0, 0}, {0, 0, 1}, {0, 0, 2.5}, {0, 0, 4}};
  const LineGeometry bends = line_geometry(points, any_normals(4));
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(bends.curvature[i], 0.0);
    EXPECT_EQ(bends.torsion[i], 0.0);
    EXPECT_EQ(bends.normal[i], Vec3::UnitX());
    EXPECT_EQ(bends.binormal[i], Vec3::UnitY());
  }
  EXPECT_EQ(tortuosity(points), 0.0);
  EXPECT_THROW(line_geometry({Vec3::Zero()}, any_normals(1)), InvalidInput);
  EXPECT_THROW(line_geometry(points, any_normals(3)), InvalidInput);
}

Centerline widening(double first_mm, double per_mm) {
  Centerline line;
  for (int i = 0; i <= 100; ++i) {
    line.points.emplace_back(0, 0, 0.3 * i);
    line.radius.push_back(first_mm + per_mm * 0.3 * i);
  }
  complete(line);
  return line;
}

TEST(LinePlace, SpheresOfATubeTouchOneRadiusApart) {
  const Centerline line = widening(2.0, 0.0);
  const LinePlace from = place_on_line(line, 10.1);
  const auto up = touching_place(line, from, LineWay::upstream);
  const auto down = touching_place(line, from, LineWay::downstream);
  ASSERT_TRUE(up && down);
  EXPECT_NEAR(value_at(line.abscissa, *up), 8.1, 1e-9);
  EXPECT_NEAR(value_at(line.abscissa, *down), 12.1, 1e-9);
  EXPECT_FALSE(touching_place(line, place_on_line(line, 1.5), LineWay::upstream));
  EXPECT_FALSE(touching_place(line, place_on_line(line, 28.5), LineWay::downstream));
  EXPECT_EQ(sphere_steps(line, {0, 0.0}).size(), 15u);  // at 0, 2, ... 28 mm of 30
}

TEST(LinePlace, InAConeTheSphereThatTouchesIsTheOneReached) {
  const Centerline line = widening(2.0, 0.1);
  // d away, of radius r(s + d): d = 2 + 0.1 (5 + d).
  const auto down = touching_place(line, place_on_line(line, 5.0), LineWay::downstream);
  ASSERT_TRUE(down);
  EXPECT_NEAR(value_at(line.abscissa, *down), 5.0 + 2.5 / 0.9, 1e-9);
  const auto up = touching_place(line, place_on_line(line, 5.0), LineWay::upstream);
  ASSERT_TRUE(up);
  EXPECT_NEAR(value_at(line.abscissa, *up), 5.0 - 2.5 / 1.1, 1e-9);
}

}  // namespace
}  // namespace ostia::geometry
