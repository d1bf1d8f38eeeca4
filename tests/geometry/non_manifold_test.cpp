#include "ostia/geometry/non_manifold.h"

#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

using test::box;

TriMesh joined(const TriMesh& a, const TriMesh& b) {
  return welded(merged(a, b));
}

TEST(Separated, LeavesASoundSurfaceAlone) {
  const TriMesh sphere = test::icosphere(2);
  const Separated out = separated(sphere);
  EXPECT_EQ(out.added_points, 0u);
  EXPECT_EQ(out.mesh.triangles, sphere.triangles);
  EXPECT_EQ(separated(test::tube(8, 3)).added_points, 0u);
}

TEST(Separated, TakesBoxesApartThatTouch) {
  struct Case {
    Vec3 lower;
    std::size_t shared;
  };
  for (const Case& at : {Case{{1, 1, 1}, 1}, Case{{1, 1, 0}, 2}}) {  // at a corner, along an edge
    const TriMesh touching = joined(box({0, 0, 0}, {1, 1, 1}), box(at.lower, at.lower + Vec3(1, 1, 1)));
    ASSERT_FALSE(find_faults(touching, false).closed_manifold());
    const Separated out = separated(touching);
    EXPECT_EQ(out.added_points, at.shared);
    const SurfaceFaults faults = find_faults(out.mesh, true);
    EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
    EXPECT_EQ(faults.components, 2u);
    EXPECT_NEAR(volume(out.mesh), 2.0, 2e-3);
    // Points that are equal joined again change nothing.
    EXPECT_EQ(welded(out.mesh).points.size(), out.mesh.points.size());
  }
}

TEST(Separated, TakesABowTieApart) {
  const TriMesh tie{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  const Separated out = separated(tie);
  EXPECT_EQ(out.added_points, 1u);
  EXPECT_EQ(out.mesh.triangles[0], tie.triangles[0]);
  EXPECT_EQ(out.mesh.triangles[1], (Triangle{5, 3, 4}));
  EXPECT_EQ(boundary_loops(out.mesh).size(), 2u);
}

TEST(Separated, LeavesAWallBetweenTwoRooms) {
  // Three sheets meet along its rim: which one goes is not for this function to say.
  TriMesh walled = test::tube(8, 3);
  const auto middle = static_cast<std::int32_t>(walled.points.size());
  walled.points.emplace_back(0.0, 0.0, 2.0);
  for (std::int32_t i = 0; i < 8; ++i) walled.triangles.push_back({8 + i, 8 + (i + 1) % 8, middle});
  ASSERT_EQ(find_faults(walled, false).non_manifold_edges, 8u);
  EXPECT_EQ(separated(walled).added_points, 0u);
}

TEST(Separated, RefusesPointsThatAreNotThere) {
  EXPECT_THROW(separated({{{0, 0, 0}}, {{0, 1, 2}}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
