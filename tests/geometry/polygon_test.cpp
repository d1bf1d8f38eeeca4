#include "ostia/geometry/polygon.h"

#include "ostia/geometry/tri_mesh.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <numeric>

namespace ostia::geometry {
namespace {

std::vector<std::int32_t> all_corners(std::size_t count) {
  std::vector<std::int32_t> corners(count);
  std::iota(corners.begin(), corners.end(), 0);
  return corners;
}

struct Areas {
  double plain = 0.0, turned = 0.0;  ///< summed along +z, and against it
};
Areas areas_of(const std::vector<Vec3>& points, const std::vector<Triangle>& triangles) {
  Areas areas;
  for (const auto& [a, b, c] : triangles) {
    const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
    const double z = 0.5 * (at(b) - at(a)).cross(at(c) - at(a)).z();
    (z > 0.0 ? areas.plain : areas.turned) += z;
  }
  return areas;
}

/// A ring whose every third corner lies hollow: a fan about the first corner folds over itself.
TEST(Polygon, WithHollowCornersIsCoveredOnce) {
  std::vector<Vec3> points;
  double area = 0.0;
  for (int i = 0; i < 30; ++i) {
    const double angle = 2.0 * std::numbers::pi * i / 30.0, r = i % 3 == 0 ? 0.7 : 1.0;
    points.emplace_back(r * std::cos(angle), r * std::sin(angle), 0.0);
  }
  for (std::size_t i = 0; i < points.size(); ++i) area += 0.5 * points[i].cross(points[(i + 1) % 30]).z();
  const auto corners = all_corners(points.size());
  std::vector<Triangle> fan;
  for (std::int32_t i = 2; i < 30; ++i) fan.push_back({0, i - 1, i});
  ASSERT_LT(areas_of(points, fan).turned, -1e-3) << "the fan of this ring does fold";
  const auto triangles = triangles_of_polygon(points, corners);
  EXPECT_EQ(triangles.size(), 28u);
  EXPECT_NEAR(areas_of(points, triangles).plain, area, 1e-9);
  EXPECT_NEAR(areas_of(points, triangles).turned, 0.0, 1e-9);
}

TEST(Polygon, WithStraightCornersGetsNoTriangleWithoutArea) {
  std::vector<Vec3> points;
  for (int side = 0; side < 4; ++side)
    for (int i = 0; i < 5; ++i) {
      const double s = i / 5.0;
      points.push_back(side == 0   ? Vec3(s, 0, 0)
                       : side == 1 ? Vec3(1, s, 0)
                       : side == 2 ? Vec3(1 - s, 1, 0)
                                   : Vec3(0, 1 - s, 0));
    }
  for (const auto& [a, b, c] : triangles_of_polygon(points, all_corners(20))) {
    const auto at = [&](std::int32_t i) { return points[static_cast<std::size_t>(i)]; };
    EXPECT_GT((at(b) - at(a)).cross(at(c) - at(a)).z(), 1e-3);
  }
}

TEST(Polygon, KeepsTheFanOfASquareAndOfWhatItCannotTell) {
  const std::vector<Vec3> square{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  const std::vector<Triangle> fan{{0, 1, 2}, {0, 2, 3}};
  EXPECT_EQ(triangles_of_polygon(square, all_corners(4)), fan);
  EXPECT_EQ(triangles_of_polygon({}, all_corners(4)), fan) << "corners that are no points";
  const std::vector<Vec3> arrow{{0, 0, 0}, {2, 1, 0}, {0.5, 1, 0}, {0, 3, 0}};  // hollow at corner 2
  EXPECT_EQ(triangles_of_polygon(arrow, all_corners(4)), fan);
  const std::vector<std::int32_t> turned{1, 2, 3, 0};
  EXPECT_NEAR(areas_of(arrow, triangles_of_polygon(arrow, turned)).turned, 0.0, 1e-12);
}

TEST(Polygon, OfManyCornersIsHalved) {
  std::vector<Vec3> points;
  for (int i = 0; i < 1200; ++i)
    points.emplace_back(std::cos(2.0 * std::numbers::pi * i / 1200.0),
                        std::sin(2.0 * std::numbers::pi * i / 1200.0), 0.0);
  const auto triangles = triangles_of_polygon(points, all_corners(1200));
  EXPECT_EQ(triangles.size(), 1198u);
  EXPECT_NEAR(areas_of(points, triangles).plain, 600.0 * std::sin(2.0 * std::numbers::pi / 1200.0), 1e-9);
}

}  // namespace
}  // namespace ostia::geometry
