#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;
using test::tube;
using ::testing::IsEmpty;

double filled_area(const FilledHoles& filled) {
  std::vector<bool> added;
  for (const std::int32_t hole : filled.hole_of_triangle) added.push_back(hole >= 0);
  return area(subset(filled.mesh, added));
}

double polygon_area(int n) {
  return 0.5 * n * std::sin(2 * pi / n);
}

TEST(FillHoles, TubeEndsGetFlatCaps) {
  for (const int around : {3, 4, 25, 100}) {
    const TriMesh open = tube(around, 4);
    const FilledHoles filled = fill_holes(open);
    const SurfaceFaults faults = find_faults(filled.mesh, true);
    EXPECT_TRUE(faults.closed_manifold()) << around << ": " << faults.summary();
    EXPECT_EQ(filled.mesh.points.size(), open.points.size());
    EXPECT_NEAR(filled_area(filled), 2 * polygon_area(around), 1e-9);
    EXPECT_NEAR(volume(filled.mesh), 4 * polygon_area(around), 1e-9);
    ASSERT_EQ(filled.hole_of_triangle.size(), filled.mesh.triangles.size());
    const auto& holes = filled.hole_of_triangle;
    EXPECT_EQ(std::count(holes.begin(), holes.end(), -1), static_cast<std::ptrdiff_t>(open.triangles.size()));
    EXPECT_EQ(std::count(holes.begin(), holes.end(), 0), around - 2);
    EXPECT_EQ(std::count(holes.begin(), holes.end(), 1), around - 2);
    for (std::size_t t = open.triangles.size(); t < holes.size(); ++t) {  // loop 0 is the lower end
      for (const std::int32_t p : filled.mesh.triangles[t]) {
        EXPECT_EQ(filled.mesh.points[static_cast<std::size_t>(p)].z(), holes[t] == 0 ? 0.0 : 4.0);
      }
    }
  }
}

TEST(FillHoles, VeryLongLoopGetsAFan) {
  const FilledHoles filled = fill_holes(tube(600, 2));
  EXPECT_TRUE(find_faults(filled.mesh, false).closed_manifold());
  EXPECT_EQ(filled.mesh.points.size(), 1202U);
  EXPECT_NEAR(volume(filled.mesh), 4 * polygon_area(600), 1e-9);
}

TEST(FillHoles, HollowOutlineIsNotBridged) {
  // An L-shaped prism without its lid; the outline's straight sides carry points of their own.
  std::vector<Vec2> outline;
  const std::vector<Vec2> corners{{0, 0}, {4, 0}, {4, 1}, {1, 1}, {1, 4}, {0, 4}};
  for (std::size_t i = 0; i < corners.size(); ++i) {
    for (int s = 0; s < 4; ++s) {
      outline.push_back(corners[i] + (corners[(i + 1) % corners.size()] - corners[i]) * (s / 4.0));
    }
  }
  const auto n = static_cast<std::int32_t>(outline.size());
  TriMesh wall;
  for (const double z : {0.0, 1.0}) {
    for (const Vec2& p : outline) wall.points.emplace_back(p.x(), p.y(), z);
  }
  for (std::int32_t i = 0; i < n; ++i) {
    const std::int32_t j = (i + 1) % n;
    wall.triangles.push_back({i, j, j + n});
    wall.triangles.push_back({i, j + n, i + n});
  }
  const FilledHoles filled = fill_holes(wall);
  const SurfaceFaults faults = find_faults(filled.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_NEAR(filled_area(filled), 14.0, 1e-9);
  EXPECT_NEAR(volume(filled.mesh), 7.0, 1e-9);
}

TEST(FillHoles, BoxGetsItsBottomAndLidBack) {
  const TriMesh cube = test::box({0, 0, 0}, {1, 1, 1});
  std::vector<bool> keep(12, true);
  keep[0] = keep[1] = keep[2] = keep[3] = false;
  const FilledHoles filled = fill_holes(subset(cube, keep));
  EXPECT_TRUE(find_faults(filled.mesh, true).closed_manifold());
  EXPECT_NEAR(volume(filled.mesh), 1.0, 1e-12);
}

TEST(FillHoles, SaddleIsSpannedTheCheaperWay) {
  // A ring of walls under a kite whose long diagonal is lifted: spanning by the short one costs less.
  TriMesh wall = tube(4, 2);
  wall.points[4] = {3, 0, 5};
  wall.points[6] = {-3, 0, 5};
  const FilledHoles filled = fill_holes(wall);
  const Vec3 right = wall.points[4], top = wall.points[5], left = wall.points[6], bottom = wall.points[7];
  const auto half = [](const Vec3& a, const Vec3& b, const Vec3& c) {
    return 0.5 * (b - a).cross(c - a).norm();
  };
  const double by_short = half(top, bottom, right) + half(top, bottom, left);
  const double by_long = half(left, right, top) + half(left, right, bottom);
  EXPECT_NEAR(filled_area(filled) - 2.0, std::min(by_short, by_long), 1e-12);
  EXPECT_GT(std::abs(by_short - by_long), 0.1);
}

TEST(FillHoles, ChordThatIsAnEdgeAlreadyIsAvoided) {
  // A tetrahedron without two faces: the loop of four has both diagonals, one of them an edge of the surface.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  const FilledHoles filled = fill_holes({points, {{0, 2, 1}, {0, 1, 3}}});
  const SurfaceFaults faults = find_faults(filled.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_NEAR(volume(filled.mesh), 1.0 / 6.0, 1e-12);
}

TEST(FillHoles, NothingToDoOnAClosedSurface) {
  const TriMesh ball = test::icosphere(2);
  const FilledHoles filled = fill_holes(ball);
  EXPECT_EQ(filled.mesh.triangles, ball.triangles);
  EXPECT_THAT(filled.hole_of_triangle, ::testing::Each(-1));
  EXPECT_THAT(fill_holes(TriMesh{}).hole_of_triangle, IsEmpty());
}

TEST(FillHoles, SeveralHolesOfASphereClose) {
  const TriMesh ball = test::icosphere(4);
  std::vector<bool> keep(ball.triangles.size(), true);
  for (std::size_t t = 0; t < keep.size(); ++t) {
    const Vec3 p = ball.points[static_cast<std::size_t>(ball.triangles[t][0])];
    keep[t] = std::abs(p.z()) < 0.9 && p.x() < 0.95;
  }
  const TriMesh open = subset(ball, keep);
  ASSERT_EQ(boundary_loops(open).size(), 3U);
  const FilledHoles filled = fill_holes(open);
  const SurfaceFaults faults = find_faults(filled.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_LT(volume(filled.mesh), volume(ball));
  EXPECT_GT(volume(filled.mesh), 0.9 * volume(ball));
}

}  // namespace
}  // namespace ostia::geometry
