#include "ostia/geometry/mesh_topology.h"

#include "test_meshes.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using std::numbers::pi;
using ::testing::Each;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(MeshTopology, AreasAndVolumes) {
  const TriMesh cuboid = test::box({-1, -2, -3}, {1, 2, 3});
  EXPECT_NEAR(area(cuboid), 2 * (8 + 24 + 12), 1e-12);
  EXPECT_NEAR(volume(cuboid), 48.0, 1e-12);
  TriMesh inward = cuboid;
  test::turn_over(inward);
  EXPECT_NEAR(volume(inward), -48.0, 1e-12);
  EXPECT_NEAR(area(test::icosphere(5, 2.0)), 16 * pi, 16 * pi * 2e-3);
  EXPECT_NEAR(volume(test::icosphere(5, 2.0, {1e5, 0, 0})), 32.0 / 3.0 * pi, 32.0 / 3.0 * pi * 3e-3);
  EXPECT_NEAR(volume(test::torus(300, 150)), 2 * pi * pi * 3, 2 * pi * pi * 3 * 1e-3);
  EXPECT_NEAR(area(test::torus(300, 150)), 4 * pi * pi * 3, 4 * pi * pi * 3 * 1e-3);
  const int n = 20;
  EXPECT_NEAR(area(test::tube(n, 5, 1.0, 4.0)), n * 2 * std::sin(pi / n) * 4.0, 1e-12);
  EXPECT_EQ(area(TriMesh{}), 0.0);
  EXPECT_EQ(volume(TriMesh{}), 0.0);
}

TEST(MeshTopology, VolumeOfTetrahedra) {
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  mesh.tetrahedra = {{0, 1, 2, 3}, {1, 2, 3, 4}};
  EXPECT_NEAR(volume(mesh), 1.0 / 6.0 + 1.0 / 3.0, 1e-15);
  mesh.tetrahedra.push_back({0, 1, 2, 5});
  EXPECT_THROW(volume(mesh), InvalidInput);
}

TEST(MeshTopology, Bounds) {
  const Box3 box = bounds(test::torus(100, 40).points);
  EXPECT_NEAR(box.max().x(), 4.0, 1e-12);
  EXPECT_NEAR(box.min().z(), -1.0, 1e-12);
  EXPECT_TRUE(bounds({}).isEmpty());
}

TEST(MeshTopology, NormalsOfASphereAndOfACube) {
  const TriMesh ball = test::icosphere(4, 3.0);
  const auto normals = vertex_normals(ball);
  for (std::size_t p = 0; p < ball.points.size(); ++p) {
    ASSERT_NEAR(normals[p].dot(ball.points[p].normalized()), 1.0, 1e-4);
  }
  // Weighted by angle, a cube's corners look along its diagonals however the faces are split.
  TriMesh cube = test::box({-1, -1, -1}, {1, 1, 1});
  cube.points.emplace_back(7, 7, 7);
  cube.triangles.push_back({0, 0, 1});
  const auto corners = vertex_normals(cube);
  for (std::size_t p = 0; p < 8; ++p)
    EXPECT_NEAR((corners[p] - cube.points[p].normalized()).norm(), 0.0, 1e-14);
  EXPECT_EQ(corners[8], Vec3(0, 0, 0));
}

TEST(MeshTopology, Neighbours) {
  const auto cube = vertex_neighbours(test::box({0, 0, 0}, {1, 1, 1}));
  EXPECT_THAT(cube[0], ElementsAre(1, 2, 3, 4, 5, 6));
  EXPECT_THAT(cube[2], ElementsAre(0, 3, 6, 7));
  std::size_t ends = 0;
  for (const auto& list : vertex_neighbours(test::icosphere(3))) {
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end()));
    ends += list.size();
  }
  EXPECT_EQ(ends, 2U * 30 * 64);
}

TEST(MeshTopology, BorderLoopsFollowTheTriangles) {
  const auto loops = boundary_loops(test::tube(6, 3));
  ASSERT_EQ(loops.size(), 2U);
  EXPECT_THAT(loops[0], ElementsAre(0, 1, 2, 3, 4, 5));
  EXPECT_THAT(loops[1], ElementsAre(12, 17, 16, 15, 14, 13));
  EXPECT_THAT(boundary_loops(test::icosphere(1)), IsEmpty());
  EXPECT_EQ(boundary_loops(merged(test::tube(6, 3), test::tube(8, 2)))[0].size(), 8U);  // longest first
}

TEST(MeshTopology, BorderLoopsRefuseWhatIsNoLoop) {
  // Two triangles that touch at a corner; and two that run along their edge the same way.
  const std::vector<Vec3> points{{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}};
  EXPECT_THROW(boundary_loops({points, {{0, 1, 2}, {0, 3, 4}}}), GeometryError);
  EXPECT_THROW(boundary_loops({points, {{0, 1, 2}, {0, 1, 4}}}), GeometryError);
  EXPECT_THROW(boundary_loops({points, {{0, 1, 5}}}), InvalidInput);
}

TEST(MeshTopology, ComponentsByLowestTriangle) {
  const TriMesh two = merged(test::box({0, 0, 0}, {1, 1, 1}), test::icosphere(1, 1.0, {5, 0, 0}));
  const auto numbers = components(two);
  EXPECT_THAT(std::vector<int>(numbers.begin(), numbers.begin() + 12), Each(0));
  EXPECT_THAT(std::vector<int>(numbers.begin() + 12, numbers.end()), Each(1));
  // A common corner does not connect.
  EXPECT_THAT(components({std::vector<Vec3>(5, Vec3::Zero()), {{0, 1, 2}, {0, 3, 4}, {2, 1, 4}}}),
              ElementsAre(0, 1, 0));
}

}  // namespace
}  // namespace ostia::geometry
