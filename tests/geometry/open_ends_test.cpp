#include "open_ends.h"

#include "surface_checks.h"

#include <gtest/gtest.h>

namespace ostia::geometry {
namespace {

TEST(FreeEnds, OfATubeAreBothAndPointOut) {
  const std::vector<FreeEnd> ends = free_ends(tapered_tube(10.0, 2.0, 1.0));
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_LT((ends[0].centre - Vec3::Zero()).norm(), 1e-12);
  EXPECT_LT((ends[0].normal + Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(ends[0].radius, 2.0);
  EXPECT_LT((ends[1].centre - Vec3(0, 0, 10)).norm(), 1e-12);
  EXPECT_LT((ends[1].normal - Vec3::UnitZ()).norm(), 1e-12);
  EXPECT_EQ(ends[1].radius, 1.0);
}

TEST(FreeEnds, AreNeitherAtBifurcationsNorOnClosedAxes) {
  EXPECT_EQ(free_ends(y_junction(10, 15, 1.5, 1.1, 60)).size(), 3u);
  EXPECT_EQ(free_ends(coronary_like_tree(0.5)).size(), 5u);
  EXPECT_TRUE(free_ends(torus(8, 2)).empty());
}

TEST(CutFlat, CutsOnlyTheEndItIsGiven) {
  const AnalyticShape shape = straight_tube(10.0, 1.5);
  TriMesh mesh = surface_of(shape, 0.3, false);
  const std::vector<FreeEnd> ends = free_ends(shape);
  cut_flat(mesh, ends[1], TubeDistance(shape), 0.3, true);
  const test::Topology t = test::topology_of(mesh);
  EXPECT_EQ(t.border_loops, 1u);
  EXPECT_EQ(t.euler, 1);
  double low = 0.0, high = 0.0;
  for (const Vec3& p : mesh.points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  EXPECT_NEAR(high, 10.0, 1e-12);
  EXPECT_LT(low, -1.4);  // the half ball at the other end is still there
}

TEST(CutFlat, LeavesNoEdgeMuchShorterThanTheGridsOwn) {
  const AnalyticShape shape = helix_tube(10.0, 15.0, 0.2, 1.3);
  const auto shortest = [](const TriMesh& mesh) {
    double least = 1e300;
    for (const Triangle& t : mesh.triangles) {
      for (std::size_t c = 0; c < 3; ++c) {
        const Vec3& p = mesh.points[static_cast<std::size_t>(t[c])];
        least = std::min(least, (mesh.points[static_cast<std::size_t>(t[(c + 1) % 3])] - p).norm());
      }
    }
    return least;
  };
  EXPECT_GT(shortest(surface_of(shape, 0.25, true)), 0.5 * shortest(surface_of(shape, 0.25, false)));
}

}  // namespace
}  // namespace ostia::geometry
