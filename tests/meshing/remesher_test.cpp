#include "remeshing/remesher.h"

#include "test_surfaces.h"

#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;

TEST(MinAngleCosine, IsOfTheSmallestAngle) {
  const Vec3 a(0, 0, 0), b(4, 0, 0), c(0.5, 1, 0);
  double largest = -1.0;
  for (const auto& [p, q, r] : {std::array{a, b, c}, {b, c, a}, {c, a, b}})
    largest = std::max(largest, (q - p).normalized().dot((r - p).normalized()));
  EXPECT_NEAR(min_angle_cosine(a, b, c), largest, 1e-14);
  EXPECT_NEAR(min_angle_cosine(c, b, a), largest, 1e-14);
  EXPECT_EQ(min_angle_cosine(a, a, b), 1.0);
}

TEST(BorderCurve, GoesRound) {
  const EditMesh mesh(grid_surface(2));
  const auto curves = border_curves(mesh);
  ASSERT_EQ(curves.size(), 1u);
  EXPECT_EQ(curves[0].points.size(), 8u);
  EXPECT_DOUBLE_EQ(curves[0].length, 8.0);
  EXPECT_NEAR((curves[0].at(0.25) - curves[0].at(8.25)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((curves[0].at(-0.5) - curves[0].at(7.5)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((curves[0].at(7.75) - curves[0].at(0.0)).norm(), 0.25, 1e-14);
}

TEST(Remesher, SplitsToTheTargetLength) {
  const auto grid = grid_surface(3);
  Remesher remesher(grid, std::vector<double>(grid.points.size(), 0.3));
  EXPECT_GT(remesher.split_long(), 0u);
  const EditMesh& mesh = remesher.mesh();
  for (std::int32_t h = 0; h < mesh.half_edge_count(); ++h)
    EXPECT_TRUE(!mesh.alive(h) || mesh.length(h) <= 0.3 * 4.0 / 3.0 + 1e-12);
  EXPECT_NEAR(geometry::area(mesh.compact()), 9.0, 1e-12);
}

TEST(Remesher, CollapsesToTheTargetLengthAndKeepsTheBorder) {
  const auto shape = geometry::straight_tube(10.0, 1.5);
  const auto tube = geometry::structured_surface(shape.tubes[0], 60, 0.15);
  Remesher remesher(tube, std::vector<double>(tube.points.size(), 0.5));
  EXPECT_GT(remesher.collapse_short(), 1000u);
  const auto result = remesher.mesh().compact();
  EXPECT_EQ(geometry::boundary_loops(result).size(), 2u);
  for (const auto& loop : geometry::boundary_loops(result))
    for (const std::int32_t v : loop) {
      const double z = result.points[static_cast<std::size_t>(v)].z();
      EXPECT_TRUE(std::abs(z) < 1e-9 || std::abs(z - 10.0) < 1e-9) << z;
    }
}

TEST(Remesher, LeavesAFrozenBorderAsItIs) {
  const auto shape = geometry::straight_tube(10.0, 1.5);
  const auto tube = geometry::structured_surface(shape.tubes[0], 30, 0.3);
  for (const double edge : {0.15, 0.6}) {  // finer and coarser than the borders
    Remesher remesher(tube, std::vector<double>(tube.points.size(), edge));
    ASSERT_EQ(remesher.curves().size(), 2u);
    remesher.freeze(1);
    for (int i = 0; i < 3; ++i) {
      remesher.split_long();
      remesher.collapse_short();
      remesher.flip_for_valence();
      remesher.relax();
    }
    remesher.mend(32.0);
    const EditMesh& mesh = remesher.mesh();
    const auto& frozen = remesher.curves()[1];
    for (std::size_t i = 0; i < frozen.vertices.size(); ++i) {
      const std::int32_t v = frozen.vertices[i];
      ASSERT_TRUE(mesh.alive_vertex(v));
      EXPECT_EQ(mesh.at(v), frozen.points[i]);
      EXPECT_EQ(mesh.target(mesh.out(v)), frozen.vertices[(i + 1) % frozen.vertices.size()]);
    }
    // The other one has taken the length asked for.
    std::size_t points = 0;
    for (const BorderCurve& curve : border_curves(mesh))
      if (remesher.curve(curve.vertices[0]) == 0) points = curve.vertices.size();
    EXPECT_NEAR(static_cast<double>(points), 2.0 * std::numbers::pi * 1.5 / edge, 0.3 * 9.42 / edge);
  }
}

TEST(Remesher, MendsATriangleWithASmallAngle) {
  // A plane grid with one point pushed near its neighbour.
  auto grid = grid_surface(8);
  grid.points[40] += Vec3(0.93, 0.0, 0.0);
  Remesher remesher(grid, std::vector<double>(grid.points.size(), 1.0));
  EXPECT_GT(remesher.mend(30.0), 0u);
  for (int i = 0; i < 5; ++i) remesher.mend(30.0);
  EXPECT_EQ(remesher.mend(30.0), 0u);
  EXPECT_NEAR(geometry::area(remesher.mesh().compact()), 64.0, 1e-9);
}

}  // namespace
}  // namespace ostia::meshing
