#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::Pair;
using Pairs = std::vector<std::pair<std::int32_t, std::int32_t>>;

TEST(SelfIntersections, CleanSurfacesHaveNone) {
  EXPECT_THAT(self_intersections(test::icosphere(4)), IsEmpty());
  EXPECT_THAT(self_intersections(test::torus(60, 30)), IsEmpty());
  EXPECT_THAT(self_intersections(test::box({0, 0, 0}, {1, 2, 3})), IsEmpty());
  EXPECT_THAT(self_intersections(test::tube(24, 40)), IsEmpty());
  EXPECT_THAT(self_intersections(test::moebius(40)), IsEmpty());
  EXPECT_THAT(self_intersections(TriMesh{}), IsEmpty());
}

TEST(SelfIntersections, NeighboursOfAnUnweldedSurfaceStillShareTheirCorners) {
  const TriMesh whole = test::icosphere(3);
  TriMesh soup;
  for (const Triangle& t : whole.triangles) {
    const auto first = static_cast<std::int32_t>(soup.points.size());
    for (const std::int32_t p : t) soup.points.push_back(whole.points[static_cast<std::size_t>(p)]);
    soup.triangles.push_back({first, first + 1, first + 2});
  }
  EXPECT_THAT(self_intersections(soup), IsEmpty());
}

/// A plane through a sphere meets exactly the triangles that reach it.
void expect_plane_meets_right_triangles(double height) {
  TriMesh mesh = test::icosphere(4);
  Pairs truth;
  const auto plane = static_cast<std::int32_t>(mesh.triangles.size());
  for (std::int32_t t = 0; t < plane; ++t) {
    double lowest = 2.0, highest = -2.0;
    for (const std::int32_t p : mesh.triangles[static_cast<std::size_t>(t)]) {
      lowest = std::min(lowest, mesh.points[static_cast<std::size_t>(p)].z());
      highest = std::max(highest, mesh.points[static_cast<std::size_t>(p)].z());
    }
    if (lowest <= height && height <= highest) truth.emplace_back(t, plane);
  }
  const auto first = static_cast<std::int32_t>(mesh.points.size());
  mesh.points.insert(mesh.points.end(), {{-9, -9, height}, {9, -8, height}, {1, 9, height}});
  mesh.triangles.push_back({first, first + 1, first + 2});
  EXPECT_EQ(self_intersections(mesh), truth);
  EXPECT_GT(truth.size(), 50U);
}

TEST(SelfIntersections, PlaneThroughSphere) {
  expect_plane_meets_right_triangles(0.1234);
  expect_plane_meets_right_triangles(0.0);  // through points and edges exactly
  expect_plane_meets_right_triangles(test::icosphere(4).points[100].z());
}

bool crosses(const TriMesh& mesh, const Triangle& a, const Triangle& b) {
  const auto at = [&](std::int32_t p) { return mesh.points[static_cast<std::size_t>(p)]; };
  for (std::size_t i = 0; i < 3; ++i) {
    Mat3 system;
    const Vec3 from = at(a[i]), to = at(a[(i + 1) % 3]);
    system << at(b[1]) - at(b[0]), at(b[2]) - at(b[0]), from - to;
    const Vec3 s = system.inverse() * (from - at(b[0]));
    if (s[0] > 0 && s[1] > 0 && s[0] + s[1] < 1 && s[2] > 0 && s[2] < 1) return true;
  }
  return false;
}

TEST(SelfIntersections, RandomSoupAgreesWithBruteForce) {
  TriMesh soup;
  const auto middles = test::random_points(300, 2.0, 1);
  const auto offsets = test::random_points(900, 0.6, 2);
  for (std::size_t i = 0; i < offsets.size(); ++i) soup.points.push_back(middles[i / 3] + offsets[i]);
  for (std::int32_t i = 0; i < 900; i += 3) soup.triangles.push_back({i, i + 1, i + 2});
  Pairs truth;
  for (std::int32_t i = 0; i < 300; ++i) {
    for (std::int32_t j = i + 1; j < 300; ++j) {
      const Triangle& a = soup.triangles[static_cast<std::size_t>(i)];
      const Triangle& b = soup.triangles[static_cast<std::size_t>(j)];
      if (crosses(soup, a, b) || crosses(soup, b, a)) truth.emplace_back(i, j);
    }
  }
  EXPECT_GT(truth.size(), 100U);
  EXPECT_EQ(self_intersections(soup), truth);

  Pairs some(truth.begin(), truth.begin() + 7);
  EXPECT_EQ(self_intersections(soup, 7), some);
  EXPECT_EQ(self_intersections(soup, 100000), truth);
  core::set_max_threads(1);
  EXPECT_EQ(self_intersections(soup), truth);
  core::set_max_threads(0);
}

/// Two triangles over six points; those with equal numbers are shared.
Pairs of_two(const std::vector<Vec3>& points, const Triangle& a, const Triangle& b) {
  return self_intersections(TriMesh{points, {a, b}});
}

TEST(SelfIntersections, MarksKeepThePairsOfMarkedTriangles) {
  TriMesh mesh;
  for (int k = 0; k < 400; ++k) {
    const auto first = static_cast<std::int32_t>(mesh.points.size());
    for (int c = 0; c < 3; ++c)
      mesh.points.emplace_back(std::sin(1.7 * k) + 0.3 * std::sin(5.0 * c + k),
                               std::cos(2.3 * k) + 0.3 * std::cos(3.0 * c + 2.0 * k),
                               std::sin(0.9 * k + 1.0) + 0.3 * std::sin(4.0 * c - k));
    mesh.triangles.push_back({first, first + 1, first + 2});
  }
  const Pairs all = self_intersections(mesh);
  ASSERT_GT(all.size(), 100U);
  for (const int step : {1, 7, 50, 1000}) {
    std::vector<std::uint8_t> marks(mesh.triangles.size(), 0);
    for (std::size_t t = 3; t < marks.size(); t += static_cast<std::size_t>(step)) marks[t] = 1;
    Pairs truth;
    for (const auto& pair : all)
      if (marks[static_cast<std::size_t>(pair.first)] != 0 ||
          marks[static_cast<std::size_t>(pair.second)] != 0)
        truth.push_back(pair);
    EXPECT_EQ(self_intersections(mesh, marks), truth) << step;
  }
  EXPECT_THAT(self_intersections(mesh, std::vector<std::uint8_t>(mesh.triangles.size(), 0)), IsEmpty());
  EXPECT_THROW(self_intersections(mesh, std::vector<std::uint8_t>(3, 1)), InvalidInput);
}

TEST(SelfIntersections, TrianglesApart) {
  const std::vector<Vec3> touching{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {1, 1, 0}, {2, 2, 3}, {1, 2, 3}};
  EXPECT_THAT(of_two(touching, {0, 1, 2}, {3, 4, 5}), ElementsAre(Pair(0, 1)));  // a corner on the face
  auto gap = touching;
  gap[3].z() = std::numeric_limits<double>::denorm_min();
  EXPECT_THAT(of_two(gap, {0, 1, 2}, {3, 4, 5}), IsEmpty());
  gap[3].z() = -std::numeric_limits<double>::denorm_min();
  EXPECT_THAT(of_two(gap, {0, 1, 2}, {3, 4, 5}), ElementsAre(Pair(0, 1)));

  const std::vector<Vec3> inside{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {1, 1, 0}, {2, 1, 0}, {1, 2, 0}};
  EXPECT_THAT(of_two(inside, {0, 1, 2}, {3, 4, 5}),
              ElementsAre(Pair(0, 1)));  // in one plane, one in the other
  EXPECT_THAT(of_two(inside, {3, 4, 5}, {0, 1, 2}), ElementsAre(Pair(0, 1)));
  const std::vector<Vec3> beside{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {4, 4, 0}, {2, 3, 0}, {3, 2, 0}};
  EXPECT_THAT(of_two(beside, {0, 1, 2}, {3, 4, 5}), IsEmpty());
  // In a vertical plane: the test must look along another axis.
  const std::vector<Vec3> upright{{0, 0, 0}, {0, 4, 0}, {0, 0, 4}, {0, 1, 1}, {0, 9, 1}, {0, 9, 2}};
  EXPECT_THAT(of_two(upright, {0, 1, 2}, {3, 4, 5}), ElementsAre(Pair(0, 1)));
}

TEST(SelfIntersections, TrianglesWithACommonCorner) {
  const std::vector<Vec3> base{{0, 0, 0}, {4, 0, 0}, {0, 4, 0}};
  const auto with = [&](const Vec3& a, const Vec3& b) {
    auto points = base;
    points.insert(points.end(), {a, b});
    return of_two(points, {0, 1, 2}, {3, 4, 0});
  };
  EXPECT_THAT(with({1, 1, 1}, {2, 1, 1}), IsEmpty());
  EXPECT_THAT(with({1, 1, 1}, {1, 1, -1}), ElementsAre(Pair(0, 1)));  // its far edge pierces the base
  EXPECT_THAT(with({9, 9, 9}, {9, 9, -9}), ElementsAre(Pair(0, 1)));  // the base's far edge pierces it
  EXPECT_THAT(with({-1, -1, 1}, {-1, -1, -1}), IsEmpty());            // crosses the plane elsewhere
  EXPECT_THAT(with({-4, 0, 0}, {0, -4, 0}), IsEmpty());               // in the plane, opposite
  EXPECT_THAT(with({1, 2, 0}, {2, 1, 0}), ElementsAre(Pair(0, 1)));   // in the plane, inside
  EXPECT_THAT(with({2, 0, 0}, {2, 0, 5}), ElementsAre(Pair(0, 1)));   // edges along each other
  EXPECT_THAT(with({9, 0, 0}, {9, -5, 0}), ElementsAre(Pair(0, 1)));
}

TEST(SelfIntersections, TrianglesWithACommonEdge) {
  const auto with = [](const Vec3& tip) {
    return of_two({{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, tip}, {0, 1, 2}, {1, 0, 3});
  };
  EXPECT_THAT(with({1, 1, 0}), ElementsAre(Pair(0, 1)));  // folded flat
  EXPECT_THAT(with({1, 1, 1e-300}), IsEmpty());           // almost
  EXPECT_THAT(with({1, -1, 0}), IsEmpty());
  EXPECT_THAT(with({0, 4, 0}), ElementsAre(Pair(0, 1)));  // the same triangle from the other side
}

TEST(SelfIntersections, DegenerateAndBrokenTrianglesAreLeftToOtherChecks) {
  TriMesh mesh = test::box({0, 0, 0}, {1, 1, 1});
  mesh.points.insert(mesh.points.end(), {{-1, 0.5, 0.5}, {0.5, 0.5, 0.5}, {2, 0.5, 0.5}});
  mesh.triangles.push_back({8, 9, 10});
  mesh.triangles.push_back({8, 8, 10});
  mesh.triangles.push_back({9, 9, 9});
  EXPECT_THAT(self_intersections(mesh), IsEmpty());
  mesh.points[9].y() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THAT(self_intersections(mesh), IsEmpty());
  mesh.triangles.push_back({0, 1, 11});
  EXPECT_THROW(self_intersections(mesh), InvalidInput);
}

TEST(SelfIntersections, CollapsedTubeWallsCrossEachOther) {
  // Two parallel tubes of radius 1 whose axes stand 1.9 apart: only triangles within both cylinders can
  // cross.
  TriMesh other = test::tube(40, 20);
  for (Vec3& p : other.points) p += Vec3(1.9, 0.01, 0.013);
  const TriMesh both = merged(test::tube(40, 20), other);
  const auto pairs = self_intersections(both);
  EXPECT_GT(pairs.size(), 20U);
  for (const auto& [a, b] : pairs) {
    EXPECT_LT(a, 1520);
    EXPECT_GE(b, 1520);
    for (const std::int32_t p : both.triangles[static_cast<std::size_t>(a)]) {
      EXPECT_GT(both.points[static_cast<std::size_t>(p)].x(), 0.8);
    }
  }
}

/// The pairs by the triangles' names before they were put into another order.
Pairs renamed(const Pairs& pairs, const std::vector<std::int32_t>& names) {
  Pairs out;
  for (const auto& [a, b] : pairs)
    out.push_back(std::minmax(names[static_cast<std::size_t>(a)], names[static_cast<std::size_t>(b)]));
  std::sort(out.begin(), out.end());
  return out;
}

// Neighbours that follow each other are searched in another order than triangles from all over.
TEST(SelfIntersections, NeitherOrderNorScaleMatters) {
  TriMesh other = test::tube(40, 20);
  for (Vec3& p : other.points) p += Vec3(1.9, 0.01, 0.013);
  const TriMesh both = merged(test::tube(40, 20), other);
  const Pairs truth = self_intersections(both);
  ASSERT_GT(truth.size(), 20U);

  std::vector<std::int32_t> names(both.triangles.size());
  TriMesh shuffled{both.points, {}};
  for (std::size_t i = 0; i < names.size(); ++i) {  // 3040 and 1009 have no common divisor
    names[i] = static_cast<std::int32_t>(i * 1009 % names.size());
    shuffled.triangles.push_back(both.triangles[static_cast<std::size_t>(names[i])]);
  }
  EXPECT_EQ(renamed(self_intersections(shuffled), names), truth);

  for (const int exponent : {-330, -200, 200, 330}) {
    TriMesh scaled = both;
    for (Vec3& p : scaled.points) p *= std::ldexp(1.0, exponent);
    EXPECT_EQ(self_intersections(scaled), truth) << exponent;
  }
}

}  // namespace
}  // namespace ostia::geometry
