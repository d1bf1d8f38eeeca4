#include "edge_table.h"

#include "test_meshes.h"

#include <gmock/gmock.h>

#include <array>
#include <limits>
#include <map>
#include <vector>

namespace ostia::geometry::detail {
namespace {

TEST(EdgeTable, EveryEdgeOfAClosedSurfaceTwiceAndOpposite) {
  const TriMesh mesh = test::icosphere(2);
  std::size_t edges = 0;
  for_each_edge(half_edges(mesh), [&](const HalfEdge* first, const HalfEdge* last) {
    ++edges;
    ASSERT_EQ(last - first, 2);
    EXPECT_LT(first[0].triangle, first[1].triangle);
    EXPECT_EQ(first[0].from(), first[1].to());
    for (int i = 0; i < 2; ++i) {
      const Triangle& t = mesh.triangles[static_cast<std::size_t>(first[i].triangle)];
      EXPECT_EQ(t[static_cast<std::size_t>(first[i].side)], first[i].from());
      EXPECT_EQ(t[static_cast<std::size_t>(first[i].side + 1) % 3], first[i].to());
    }
  });
  EXPECT_EQ(edges, mesh.points.size() + mesh.triangles.size() - 2);  // Euler
}

TEST(EdgeTable, TrianglesThatRepeatACornerHaveNoSides) {
  EXPECT_TRUE(half_edges({std::vector<Vec3>(2, Vec3::Zero()), {{0, 1, 0}, {1, 1, 1}}}).empty());
}

TEST(EdgeTable, SetsAreNamedByTheirLowestMember) {
  DisjointSets sets(6);
  sets.join(5, 3);
  sets.join(4, 2);
  sets.join(5, 4);
  EXPECT_EQ(sets.find(5), 2);
  EXPECT_EQ(sets.find(3), 2);
  EXPECT_EQ(sets.find(1), 1);
}

TEST(EdgeTable, EqualPoints) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const double next = std::nextafter(1.0, 2.0);
  EXPECT_THAT(
      first_equal_points({{1, 0, 0}, {next, 0, 0}, {1, -0.0, 0}, {nan, 0, 0}, {nan, 0, 0}, {next, 0, 0}}),
      ::testing::ElementsAre(0, 1, 0, 3, 4, 1));
}

TEST(EdgeTable, EqualPointsAmongMany) {
  std::vector<Vec3> points;
  for (int i = 0; i < 150000; ++i) points.emplace_back(i % 4099 * 0.1, i % 7, -(i % 3));
  std::map<std::array<double, 3>, std::int32_t> known;
  std::vector<std::int32_t> truth;
  for (const Vec3& p : points)
    truth.push_back(known.emplace(std::array{p.x(), p.y(), p.z()}, static_cast<std::int32_t>(truth.size()))
                        .first->second);
  ASSERT_LT(known.size(), points.size());
  EXPECT_EQ(first_equal_points(points), truth);
}

}  // namespace
}  // namespace ostia::geometry::detail
