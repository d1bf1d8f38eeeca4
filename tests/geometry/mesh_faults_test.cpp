#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

using test::box;
using test::icosphere;

bool near_any(const std::vector<Vec3>& places, const Vec3& place) {
  return std::any_of(places.begin(), places.end(), [&](const Vec3& p) { return (p - place).norm() < 1e-9; });
}

TEST(Faults, NoneOnClosedSurfaces) {
  for (const TriMesh& mesh : {icosphere(3), test::torus(20, 10), box({0, 0, 0}, {1, 1, 1})}) {
    const SurfaceFaults faults = find_faults(mesh, true);
    EXPECT_TRUE(faults.closed_manifold());
    EXPECT_EQ(faults.summary(), "none");
    EXPECT_EQ(faults.components, 1U);
    EXPECT_TRUE(faults.examples.empty());
  }
  EXPECT_FALSE(find_faults(TriMesh{}, true).closed_manifold());
}

TEST(Faults, OpenTube) {
  const SurfaceFaults faults = find_faults(test::tube(12, 4), true);
  EXPECT_EQ(faults.open_edges, 24U);
  EXPECT_EQ(faults.summary(), "24 open edges");
  EXPECT_FALSE(faults.closed_manifold());
  EXPECT_EQ(faults.examples.size(), 10U);
  for (const Vec3& p : faults.examples) EXPECT_TRUE(p.z() == 0.0 || p.z() == 4.0);
}

TEST(Faults, PointsThatAreNotFiniteDuplicateOrUnused) {
  TriMesh mesh = icosphere(1);
  mesh.points.push_back({9, 9, 9});
  mesh.points.push_back(mesh.points[3]);
  mesh.points.push_back({-0.0, 8, 8});
  mesh.points.push_back({0.0, 8, 8});
  SurfaceFaults faults = find_faults(mesh, false);
  EXPECT_EQ(faults.unused_points, 4U);
  EXPECT_EQ(faults.duplicate_points, 2U);
  EXPECT_TRUE(near_any(faults.examples, mesh.points[3]));
  EXPECT_TRUE(near_any(faults.examples, {9, 9, 9}));
  mesh = icosphere(1);
  mesh.points.push_back({9, 9, 9});
  EXPECT_TRUE(find_faults(mesh, true).closed_manifold());  // an unused point harms nobody
  mesh.points[5].x() = std::numeric_limits<double>::infinity();
  faults = find_faults(mesh, true);
  EXPECT_EQ(faults.non_finite_points, 1U);
  EXPECT_FALSE(faults.closed_manifold());
  for (const Vec3& p : faults.examples) EXPECT_TRUE(p.allFinite());
}

TEST(Faults, DegenerateAndDuplicateTriangles) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.push_back({0, 0, 3});
  mesh.triangles.push_back({3, 0, 2});
  mesh.triangles.push_back({2, 0, 3});
  mesh.points.push_back({0.1, 0.1, 0.1});
  mesh.points.push_back({0.2, 0.2, 0.2});
  mesh.points.push_back({0.3, 0.3, 0.3});  // on one line but for rounding
  mesh.triangles.push_back({8, 9, 10});
  const SurfaceFaults faults = find_faults(mesh, false);
  EXPECT_EQ(faults.degenerate_triangles, 2U);
  EXPECT_EQ(faults.duplicate_triangles, 2U);
  EXPECT_EQ(faults.non_manifold_edges, 3U);  // the three edges of the thrice-given triangle
  EXPECT_EQ(faults.open_edges, 3U);
  EXPECT_EQ(faults.components, 3U);  // the box, the triangle that repeats a corner, the one without area
  EXPECT_FALSE(faults.closed_manifold());
  EXPECT_TRUE(near_any(faults.examples, {0.2, 0.2, 0.2}));
}

TEST(Faults, EdgeWithThreeTriangles) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.points.emplace_back(-1, -1, 0.5);
  mesh.triangles.push_back({0, 4, 8});  // a fin
  const SurfaceFaults faults = find_faults(mesh, true);
  EXPECT_EQ(faults.non_manifold_edges, 1U);
  EXPECT_EQ(faults.open_edges, 2U);
  EXPECT_EQ(faults.non_manifold_vertices, 0U);
  EXPECT_EQ(faults.self_intersections, 0U);
  EXPECT_TRUE(near_any(faults.examples, {0, 0, 0.5}));
}

TEST(Faults, CubesThatTouchAtACorner) {
  const TriMesh mesh = welded(merged(box({0, 0, 0}, {1, 1, 1}), box({1, 1, 1}, {2, 2, 2})));
  const SurfaceFaults faults = find_faults(mesh, true);
  EXPECT_EQ(faults.non_manifold_vertices, 1U);
  EXPECT_EQ(faults.summary(), "1 non-manifold vertex");
  EXPECT_EQ(faults.components, 2U);
  ASSERT_EQ(faults.examples.size(), 1U);
  EXPECT_EQ(faults.examples[0], Vec3(1, 1, 1));
}

TEST(Faults, OneTriangleTurnedOver) {
  TriMesh mesh = icosphere(2);
  std::swap(mesh.triangles[7][0], mesh.triangles[7][1]);
  const SurfaceFaults faults = find_faults(mesh, true);
  EXPECT_EQ(faults.inconsistent_edges, 3U);
  EXPECT_EQ(faults.summary(), "3 inconsistent edges");
}

TEST(Faults, MoebiusStripHasOneBorderAndNoOrientation) {
  const SurfaceFaults faults = find_faults(test::moebius(30), true);
  EXPECT_EQ(faults.open_edges, 60U);
  EXPECT_EQ(faults.inconsistent_edges, 1U);
  EXPECT_EQ(faults.non_manifold_vertices, 0U);
  EXPECT_EQ(faults.self_intersections, 0U);
}

TEST(Faults, SelfIntersectionsOnlyWhenAskedForAndShownFirst) {
  const TriMesh mesh = merged(icosphere(3), icosphere(3, 1.0, {1.5, 0.01, 0.02}));
  EXPECT_TRUE(find_faults(mesh, false).closed_manifold());
  const SurfaceFaults faults = find_faults(mesh, true);
  EXPECT_GT(faults.self_intersections, 20U);
  EXPECT_FALSE(faults.closed_manifold());
  ASSERT_EQ(faults.examples.size(), 10U);
  // Where two spheres meet: on the circle of radius sqrt(1 - 0.75^2) around the middle.
  for (const Vec3& p : faults.examples) {
    EXPECT_NEAR(p.x(), 0.75, 0.12);
    EXPECT_NEAR(std::hypot(p.y(), p.z()), std::sqrt(1 - 0.5625), 0.12);
  }
}

TEST(Faults, EveryKindGetsAnExample) {
  TriMesh mesh = test::tube(40, 3);
  mesh.points.push_back({7, 7, 7});
  EXPECT_TRUE(near_any(find_faults(mesh, false).examples, {7, 7, 7}));
}

TEST(Faults, RefusesWrongIndices) {
  EXPECT_THROW(find_faults({{{0, 0, 0}}, {{0, 0, 1}}}, false), InvalidInput);
  EXPECT_THROW(find_faults({{{0, 0, 0}}, {{0, -1, 0}}}, false), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
