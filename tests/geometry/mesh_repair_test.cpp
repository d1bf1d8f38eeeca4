#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>

#include <cmath>
#include <limits>
#include <random>

namespace ostia::geometry {
namespace {

using test::box;
using test::icosphere;
using ::testing::ElementsAre;

constexpr double nan_mesh_repair = std::numeric_limits<double>::quiet_NaN();

/// Every triangle with corners of its own, moved by up to `noise`, as STL files have them.
TriMesh soup_of(const TriMesh& mesh, double noise = 0.0) {
  const auto moves = test::random_points(3 * mesh.triangles.size(), noise, 3);
  TriMesh soup;
  for (const Triangle& t : mesh.triangles) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t p : t) {
      soup.points.push_back(mesh.points[static_cast<std::size_t>(p)] + moves[soup.points.size()]);
    }
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  return soup;
}

TEST(Welded, SoupBecomesTheSurfaceAgain) {
  const TriMesh whole = icosphere(3);
  const TriMesh exact = welded(soup_of(whole));
  EXPECT_EQ(exact.points.size(), whole.points.size());
  EXPECT_TRUE(find_faults(exact, true).closed_manifold());
  const TriMesh noisy = soup_of(whole, 1e-5);
  EXPECT_EQ(welded(noisy).points.size(), 3 * whole.triangles.size());
  const TriMesh near = welded(noisy, 1e-4);
  EXPECT_EQ(near.points.size(), whole.points.size());
  EXPECT_EQ(near.triangles.size(), whole.triangles.size());
  EXPECT_TRUE(find_faults(near, true).closed_manifold());
  EXPECT_NEAR(volume(near), volume(whole), 1e-4);
}

TEST(Welded, ToleranceIsInclusiveAndTheFirstPointStays) {
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1.25, 0, 0}, {0, 0, 5}, {-0.25, 0, 0}};
  const TriMesh mesh{points, {{0, 1, 2}, {3, 5, 4}}};
  const TriMesh near = welded(mesh, 0.25);
  EXPECT_THAT(near.points, ElementsAre(points[0], points[1], points[2], points[4]));
  EXPECT_THAT(near.triangles, ElementsAre(Triangle{0, 1, 2}, Triangle{1, 0, 3}));
  EXPECT_EQ(welded(mesh, 0.2499).points.size(), 6U);
  EXPECT_EQ(welded(mesh, 1e-300).points.size(), 6U);
  EXPECT_EQ(welded(mesh, 1e300).triangles.size(), 0U);
}

TEST(Welded, DropsWhatAMesherChokesOn) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.points.push_back({nan_mesh_repair, 0, 0});
  mesh.points.push_back({5, 5, 5});
  mesh.triangles.insert(mesh.triangles.begin(), {{0, 0, 1}, {2, 3, 0}, {0, 1, 8}});
  mesh.triangles.push_back({3, 2, 0});
  const TriMesh clean = welded(mesh);
  EXPECT_EQ(clean.points.size(), 8U);
  EXPECT_EQ(clean.triangles.size(), 12U);
  EXPECT_TRUE(find_faults(clean, true).closed_manifold());
}

TEST(Welded, FlatTriangleInTheSurfaceGoesWithoutLeavingACrack) {
  // A point on the middle of an edge, known to one side only through a triangle without area.
  TriMesh mesh = box({0, 0, 0}, {2, 2, 2});
  mesh.points.push_back({0, 1, 0});
  mesh.triangles[0] = {0, 8, 3};  // was 0, 2, 3
  mesh.triangles.push_back({8, 2, 3});
  mesh.triangles.push_back({0, 2, 8});
  EXPECT_EQ(find_faults(mesh, false).summary(), "1 degenerate triangle");
  const TriMesh clean = welded(mesh);
  EXPECT_TRUE(find_faults(clean, true).closed_manifold()) << find_faults(clean, true).summary();
  EXPECT_EQ(clean.points.size(), 9U);
  EXPECT_NEAR(volume(clean), 8.0, 1e-12);
}

TEST(Welded, RefusesBadInput) {
  EXPECT_THROW(welded(box({0, 0, 0}, {1, 1, 1}), -1.0), InvalidInput);
  EXPECT_THROW(welded(box({0, 0, 0}, {1, 1, 1}), nan_mesh_repair), InvalidInput);
  EXPECT_THROW(welded({{}, {{0, 1, 2}}}), InvalidInput);
}

TEST(Oriented, RandomlyTurnedTrianglesComeOutOutward) {
  const TriMesh whole = merged(icosphere(3), test::torus(30, 15, 9.0));
  TriMesh mesh = whole;
  std::mt19937 generator(1);
  for (Triangle& t : mesh.triangles) {
    if (generator() % 2) std::swap(t[0], t[1]);
  }
  const TriMesh turned = oriented(mesh);
  EXPECT_EQ(find_faults(turned, false).inconsistent_edges, 0U);
  EXPECT_NEAR(volume(turned), volume(whole), 1e-9);
  TriMesh inward = whole;
  test::turn_over(inward);
  EXPECT_NEAR(volume(oriented(inward)), volume(whole), 1e-9);
}

TEST(Oriented, OpenSurfaceFollowsItsFirstTriangle) {
  const TriMesh whole = test::tube(12, 5);
  TriMesh mesh = whole;
  std::swap(mesh.triangles[3][0], mesh.triangles[3][1]);
  std::swap(mesh.triangles[9][1], mesh.triangles[9][2]);
  EXPECT_EQ(find_faults(oriented(mesh), false).inconsistent_edges, 0U);
  EXPECT_EQ(oriented(mesh).triangles[0], whole.triangles[0]);
  TriMesh inward = whole;
  test::turn_over(inward);
  EXPECT_EQ(oriented(inward).triangles, inward.triangles);
}

TEST(Oriented, MoebiusStripIsRefused) {
  EXPECT_THROW(oriented(test::moebius(20)), GeometryError);
}

TEST(Subset, KeepsTrianglesAndTheirPoints) {
  const TriMesh both = merged(box({0, 0, 0}, {1, 1, 1}), icosphere(1));
  std::vector<bool> keep(both.triangles.size(), true);
  std::fill(keep.begin(), keep.begin() + 12, false);
  keep[3] = true;
  std::vector<std::int32_t> old;
  const TriMesh part = subset(both, keep, &old);
  EXPECT_EQ(part.triangles.size(), 81U);
  EXPECT_EQ(part.points.size(), 3U + 42U);
  ASSERT_EQ(old.size(), 81U);
  for (std::size_t t = 0; t < old.size(); ++t) {
    for (std::size_t i = 0; i < 3; ++i) {
      ASSERT_EQ(part.points[static_cast<std::size_t>(part.triangles[t][i])],
                both.points[static_cast<std::size_t>(both.triangles[static_cast<std::size_t>(old[t])][i])]);
    }
  }
  EXPECT_EQ(old[0], 3);
  EXPECT_THROW(subset(both, std::vector<bool>(3, true)), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
