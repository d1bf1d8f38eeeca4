#include "scene/wall_cut.h"

#include <gtest/gtest.h>

#include <cmath>

namespace ostia::view {
namespace {

using geometry::Vec3;

/// A ball of 5 mm by latitudes and longitudes; `rows` from its south pole on.
geometry::TriMesh ball(int rows) {
  constexpr int around = 48, all_rows = 24;
  constexpr double radius = 5.0;
  geometry::TriMesh mesh;
  for (int r = 0; r <= rows; ++r)
    for (int i = 0; i < around; ++i) {
      const double up = M_PI * (r + 0.5) / (all_rows + 1.0), turn = 2.0 * M_PI * i / around;
      mesh.points.push_back(
          radius * Vec3(std::sin(up) * std::cos(turn), std::sin(up) * std::sin(turn), -std::cos(up)));
    }
  for (int r = 0; r < rows; ++r)
    for (int i = 0; i < around; ++i) {
      const int a = r * around + i, b = r * around + (i + 1) % around;
      mesh.triangles.push_back({a, b, a + around});
      mesh.triangles.push_back({b, b + around, a + around});
    }
  return mesh;
}

/// Seen from above, at 10 px a mm.
std::vector<lumen::ContourLine> cut_at(const geometry::TriMesh& mesh, double z, double slack_mm = 0.0,
                                       double widest_px = 1e9) {
  std::vector<double> out;
  for (const Vec3& p : mesh.points) out.push_back(p.z() - z);
  return wall_cut(mesh, out, slack_mm, widest_px, [&](std::size_t i) -> std::optional<SeenCorner> {
    return SeenCorner{10.0 * mesh.points[i].head<2>(), out[i]};
  });
}

TEST(WallCut, OfABallIsACircle) {
  const geometry::TriMesh mesh = ball(24);
  for (const double z : {-3.1, 0.0, 2.0}) {
    const auto lines = cut_at(mesh, z);
    ASSERT_EQ(lines.size(), 1U) << z;
    EXPECT_TRUE(lines.front().closed()) << z;
    ASSERT_EQ(lines.front().picture_px.size(), lines.front().world.size());
    for (std::size_t i = 0; i < lines.front().world.size(); ++i) {
      const Vec3& p = lines.front().world[i];
      EXPECT_NEAR(p.z(), z, 1e-9);
      EXPECT_NEAR(p.head<2>().norm(), std::sqrt(25.0 - z * z), 0.05);
      EXPECT_LT((10.0 * p.head<2>() - lines.front().picture_px[i]).norm(), 1e-9);
    }
  }
  EXPECT_TRUE(cut_at(mesh, 7.0).empty());
}

TEST(WallCut, OfAnOpenSurfaceIsALineWithEnds) {
  geometry::TriMesh mesh = ball(24);
  std::erase_if(mesh.triangles, [&](const geometry::Triangle& t) {
    return mesh.points[static_cast<std::size_t>(t[0])].x() < 0.0;
  });
  const auto lines = cut_at(mesh, 1.0);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_FALSE(lines.front().closed());
  double length = 0.0;
  for (std::size_t i = 1; i < lines.front().world.size(); ++i)
    length += (lines.front().world[i] - lines.front().world[i - 1]).norm();
  EXPECT_NEAR(length, M_PI * std::sqrt(24.0), 1.0);
}

TEST(WallCut, LeavesOutWhatIsNotSeenAndWhatTheViewTearsApart) {
  const geometry::TriMesh mesh = ball(24);
  std::vector<double> out(mesh.points.size(), std::nan(""));
  EXPECT_TRUE(wall_cut(mesh, out, 1.0, 1e9, [](std::size_t) { return SeenCorner{}; }).empty());
  EXPECT_TRUE(cut_at(mesh, 1.0, 0.0, 1.0).empty()) << "no triangle is so narrow";
  for (std::size_t i = 0; i < out.size(); ++i) out[i] = mesh.points[i].z();
  EXPECT_TRUE(wall_cut(mesh, out, 0.0, 1e9, [](std::size_t) { return std::optional<SeenCorner>(); }).empty());
}

TEST(WallCut, AboutWhereIsEnoughToFindTheTriangles) {
  const geometry::TriMesh mesh = ball(24);
  std::vector<double> about, exact;
  for (const Vec3& p : mesh.points) {
    exact.push_back(p.z() - 1.0);
    about.push_back(p.z() - 1.0 + 0.3 * std::sin(7.0 * p.x()));
  }
  const auto seen = [&](std::size_t i) -> std::optional<SeenCorner> {
    return SeenCorner{10.0 * mesh.points[i].head<2>(), exact[i]};
  };
  const auto lines = wall_cut(mesh, about, 0.3, 1e9, seen);
  ASSERT_EQ(lines.size(), 1U);
  EXPECT_TRUE(lines.front().closed());
  EXPECT_EQ(lines.front().picture_px.size(), cut_at(mesh, 1.0).front().picture_px.size());
}

}  // namespace
}  // namespace ostia::view
