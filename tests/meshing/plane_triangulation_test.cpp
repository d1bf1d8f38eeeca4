#include "cutting/plane_triangulation.h"

#include "ostia/core/error.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

std::vector<Vec3> ring(int n, double bump) {
  const Vec3 u = Vec3(1, 2, 3).normalized(), w = u.unitOrthogonal(), origin(10, 20, 30);
  std::vector<Vec3> loop;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n, r = 2.0 * (1.0 + bump * std::cos(3.0 * a));
    loop.push_back(origin + r * (std::cos(a) * w + std::sin(a) * u.cross(w)));
  }
  return loop;
}

TEST(PlaneTriangulation, FillsALoopExactlyWithGoodTriangles) {
  for (const double bump : {0.0, 0.4}) {  // round, and with three bays
    const auto loop = ring(40, bump);
    const FlatPatch patch = triangulate_flat(loop, 0.0, "a ring");
    std::vector<Vec3> points = loop;
    points.insert(points.end(), patch.inner_points.begin(), patch.inner_points.end());
    const Vec3 normal = loop_normal(loop);
    double area = 0.0, worst = 180.0;
    for (const auto& t : patch.triangles) {
      const Vec3 &a = points[static_cast<std::size_t>(t[0])], &b = points[static_cast<std::size_t>(t[1])],
                 &c = points[static_cast<std::size_t>(t[2])];
      const double doubled = (b - a).cross(c - a).dot(normal.normalized());
      EXPECT_GT(doubled, 0.0);
      area += doubled;
      worst = std::min(worst, min_angle_deg(a, b, c));
    }
    EXPECT_NEAR(area, normal.norm(), 1e-9 * normal.norm());
    EXPECT_GT(worst, 25.0);
    EXPECT_GT(patch.inner_points.size(), 20u);
    for (const Vec3& p : patch.inner_points) EXPECT_NEAR((p - loop[0]).dot(normal.normalized()), 0.0, 1e-12);
  }
}

double least_angle(const std::vector<Vec3>& loop, const FlatPatch& patch) {
  std::vector<Vec3> points = loop;
  points.insert(points.end(), patch.inner_points.begin(), patch.inner_points.end());
  double least = 180.0;
  for (const auto& t : patch.triangles)
    least = std::min(
        least, min_angle_deg(points[static_cast<std::size_t>(t[0])], points[static_cast<std::size_t>(t[1])],
                             points[static_cast<std::size_t>(t[2])]));
  return least;
}

TEST(PlaneTriangulation, OpensSmallAnglesWhereItIsAskedTo) {
  // Rings as remeshing leaves them: 9 to 24 edges around an uneven section. One lattice is not good for
  // all.
  double worst_of_one = 180.0;
  for (int n = 9; n <= 24; ++n) {
    std::vector<Vec3> loop;
    for (int i = 0; i < n; ++i) {
      const double b = 2.0 * std::numbers::pi * i / n, a = b + 0.08 * std::sin(2.0 * b + n),
                   r = 2.0 * (1.0 + 0.15 * std::cos(2.0 * a) + 0.05 * std::cos(3.0 * a + n));
      loop.emplace_back(r * std::cos(a), r * std::sin(a), 1.0);
    }
    worst_of_one = std::min(worst_of_one, least_angle(loop, triangulate_flat(loop, 0.0, "a ring")));
    const FlatPatch good = triangulate_flat(loop, 0.0, "a ring", 32.0);
    EXPECT_GE(least_angle(loop, good), 32.0) << n;
    double area = 0.0;
    std::vector<Vec3> points = loop;
    points.insert(points.end(), good.inner_points.begin(), good.inner_points.end());
    for (const auto& t : good.triangles) {
      const Vec3& a = points[static_cast<std::size_t>(t[0])];
      const double doubled =
          (points[static_cast<std::size_t>(t[1])] - a).cross(points[static_cast<std::size_t>(t[2])] - a).z();
      EXPECT_GT(doubled, 0.0);
      area += doubled;
    }
    EXPECT_NEAR(area, loop_normal(loop).norm(), 1e-12 * area);
  }
  EXPECT_LT(worst_of_one, 31.0);  // which the first lattice alone does not reach
}

TEST(PlaneTriangulation, CopesWithPointsOnALine) {
  // Squares whose sides carry points to round-off in line: no degenerate triangle may come of them.
  std::vector<Vec3> loop;
  const std::vector<Vec3> corners{{0.1, 0.2, 0.3}, {1.1, 0.2, 0.3}, {1.1, 1.2, 0.3}, {0.1, 1.2, 0.3}};
  for (std::size_t i = 0; i < 4; ++i)
    for (int k = 0; k < 7; ++k) loop.push_back(corners[i] + k / 7.0 * (corners[(i + 1) % 4] - corners[i]));
  const FlatPatch patch = triangulate_flat(loop, 0.0, "a square");
  double area = 0.0;
  for (const auto& t : patch.triangles) {
    auto at = [&](std::int32_t v) {
      return static_cast<std::size_t>(v) < loop.size()
                 ? loop[static_cast<std::size_t>(v)]
                 : patch.inner_points[static_cast<std::size_t>(v) - loop.size()];
    };
    const double angle = min_angle_deg(at(t[0]), at(t[1]), at(t[2]));
    EXPECT_GT(angle, 20.0);
    area += 0.5 * (at(t[1]) - at(t[0])).cross(at(t[2]) - at(t[0])).norm();
  }
  EXPECT_NEAR(area, 1.0, 1e-12);
}

/// A border a hundred times finer than its hole is wide.
TEST(PlaneTriangulation, AFineBorderDoesNotMakeTheWholeCapAsFine) {
  constexpr int points = 3000;
  std::vector<Vec3> loop;
  for (int i = 0; i < points; ++i) {
    const double angle = 2.0 * M_PI * i / points;
    loop.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const FlatPatch patch = triangulate_flat(loop, 0.0, "a ring", 25.0);
  EXPECT_LT(patch.inner_points.size(), 15000U);
  EXPECT_EQ(patch.triangles.size(), points + 2 * patch.inner_points.size() - 2);  // Euler
}

TEST(PlaneTriangulation, NamesALoopThatCrossesItself) {
  const std::vector<Vec3> eight{{0, 0, 0}, {2, 2.5, 0}, {2, 0, 0}, {0, 2, 0}};
  try {
    triangulate_flat(eight, 0.5, "outlet_x");
    FAIL();
  } catch (const GeometryError& error) {
    EXPECT_NE(std::string(error.what()).find("outlet_x"), std::string::npos);
  }
  EXPECT_THROW(triangulate_flat({{0, 0, 0}, {1, 0, 0}}, 0.5, "x"), GeometryError);
  EXPECT_THROW(triangulate_flat({{0, 0, 0}, {1, 0, 0}, {2, 0, 0}}, 0.5, "x"), GeometryError);
}

}  // namespace
}  // namespace ostia::meshing
