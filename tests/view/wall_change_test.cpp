#include "scene/wall_change.h"

#include "vessel_trees.h"

#include "ostia/lumen/start_surface.h"
#include "ostia/lumen/tree_surface.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::view {
namespace {

/// A flat grid of n x n points, a millimetre apart, in rows.
geometry::TriMesh grid(int n) {
  geometry::TriMesh mesh;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) mesh.points.emplace_back(i, j, 0.0);
  for (int j = 0; j + 1 < n; ++j)
    for (int i = 0; i + 1 < n; ++i) {
      const std::int32_t a = j * n + i;
      mesh.triangles.push_back({a, a + 1, a + n + 1});
      mesh.triangles.push_back({a, a + n + 1, a + n});
    }
  return mesh;
}

TEST(WallChangeTest, FindsWhatDiffersAndHowFarTheRestHasMoved) {
  const geometry::TriMesh before = grid(10);
  const WallChange none = change_between(before, before);
  EXPECT_EQ(none.first, 100U);
  EXPECT_TRUE(none.box.isEmpty());
  geometry::TriMesh after = before;
  after.points[33].z() = 0.5;
  after.points[57].z() = 0.25;
  const WallChange moved = change_between(before, after);
  EXPECT_EQ(moved.first, 33U);
  EXPECT_EQ(moved.last, 58U);
  EXPECT_EQ(moved.shift, 0);
  EXPECT_TRUE(moved.box.min().isApprox(geometry::Vec3(3.0, 3.0, 0.0)));
  EXPECT_TRUE(moved.box.max().isApprox(geometry::Vec3(7.0, 5.0, 0.5)));
  after = before;
  after.points.insert(after.points.begin() + 40, 3, geometry::Vec3(0.5, 4.0, 0.0));
  const WallChange longer = change_between(before, after);
  EXPECT_EQ(longer.first, 40U);
  EXPECT_EQ(longer.last, 43U);
  EXPECT_EQ(longer.shift, 3);
  EXPECT_EQ(before.points[60], after.points[63]);
  const WallChange shorter = change_between(after, before);
  EXPECT_EQ(shorter.first, 40U);
  EXPECT_EQ(shorter.last, 40U);
  EXPECT_EQ(shorter.shift, -3);
  EXPECT_FALSE(shorter.box.isEmpty());
}

TEST(WallChangeTest, APieceHasTheWallsTrianglesAndNormals) {
  geometry::TriMesh wall = grid(12);
  for (geometry::Vec3& p : wall.points) p.z() = std::sin(0.7 * p.x()) * std::cos(0.5 * p.y());
  const geometry::Box3 box(geometry::Vec3(3.5, 2.5, -2.0), geometry::Vec3(7.5, 6.5, 2.0));
  const WallPiece piece = piece_within(wall, box);
  const std::vector<char> within = triangles_within(wall, box);
  EXPECT_EQ(piece.mesh.triangles.size(),
            static_cast<std::size_t>(std::count(within.begin(), within.end(), 1)));
  EXPECT_LT(piece.mesh.triangles.size(), wall.triangles.size());
  const std::vector<Eigen::Vector3f> normals = smooth_normals(wall);
  std::size_t next = 0;
  for (std::size_t i = 0; i < within.size(); ++i) {
    bool touches = false;
    for (const std::int32_t corner : wall.triangles[i])
      touches = touches || box.contains(wall.points[static_cast<std::size_t>(corner)]);
    ASSERT_EQ(within[i] != 0, touches);
    if (!touches) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(piece.mesh.triangles[next][c]);
      ASSERT_EQ(piece.points[at], wall.triangles[i][c]);
      EXPECT_EQ(piece.mesh.points[at], wall.points[static_cast<std::size_t>(piece.points[at])]);
      EXPECT_EQ(piece.normals[at], normals[static_cast<std::size_t>(piece.points[at])]);
    }
    ++next;
  }
}

TEST(WallChangeTest, NormalsPointOutOfTheVessel) {
  const geometry::TriMesh wall =
      lumen::surface_of(lumen::model_of_tubes(lumen::testing::straight_vessel(40.0, 2.0)), 0.25);
  const std::vector<Eigen::Vector3f> normals = smooth_normals(wall);
  ASSERT_EQ(normals.size(), wall.points.size());
  double worst = 1.0;
  for (std::size_t i = 0; i < normals.size(); ++i) {
    const geometry::Vec3& p = wall.points[i];
    if (p.z() < 2.0 || p.z() > 38.0) continue;
    worst = std::min(worst, normals[i].cast<double>().dot(geometry::Vec3(p.x(), p.y(), 0.0).normalized()));
  }
  EXPECT_GT(worst, 0.97);
}

}  // namespace
}  // namespace ostia::view
