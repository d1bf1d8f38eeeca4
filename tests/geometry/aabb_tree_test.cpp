#include "ostia/geometry/aabb_tree.h"

#include "test_meshes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace ostia::geometry {
namespace {

using test::box;
using test::icosphere;
using test::random_points;
using test::torus;

constexpr double nan = std::numeric_limits<double>::quiet_NaN();

/// Distance to a triangle by another road: the plane's foot when inside the three edges, else the nearest
/// edge.
double brute_distance(const TriMesh& mesh, const Triangle& t, const Vec3& q) {
  const Vec3 p[3] = {mesh.points[static_cast<std::size_t>(t[0])], mesh.points[static_cast<std::size_t>(t[1])],
                     mesh.points[static_cast<std::size_t>(t[2])]};
  const Vec3 normal = (p[1] - p[0]).cross(p[2] - p[0]);
  bool within = normal.norm() > 1e-12;
  double best = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const Vec3 a = p[i], d = p[(i + 1) % 3] - a;
    within = within && normal.dot(d.cross(q - a)) >= 0.0;
    const double s = d.squaredNorm() > 0.0 ? std::clamp((q - a).dot(d) / d.squaredNorm(), 0.0, 1.0) : 0.0;
    best = std::min(best, (q - a - s * d).norm());
  }
  return within ? std::abs((q - p[0]).dot(normal.normalized())) : best;
}

double brute_distance(const TriMesh& mesh, const Vec3& q) {
  double best = std::numeric_limits<double>::infinity();
  for (const Triangle& t : mesh.triangles) best = std::min(best, brute_distance(mesh, t, q));
  return best;
}

void expect_closest_is_right(const TriMesh& mesh, const std::vector<Vec3>& queries) {
  const AabbTree tree(mesh);
  for (const Vec3& q : queries) {
    const SurfacePoint found = tree.closest(q);
    const double truth = brute_distance(mesh, q);
    ASSERT_NEAR(found.distance, truth, 1e-12 * (1.0 + truth));
    ASSERT_GE(found.triangle, 0);
    const Triangle& t = mesh.triangles[static_cast<std::size_t>(found.triangle)];
    Vec3 point = Vec3::Zero();
    for (int i = 0; i < 3; ++i) {
      point += found.barycentric[i] * mesh.points[static_cast<std::size_t>(t[static_cast<std::size_t>(i)])];
    }
    ASSERT_NEAR(found.barycentric.sum(), 1.0, 1e-12);
    ASSERT_GE(found.barycentric.minCoeff(), 0.0);
    ASSERT_NEAR((point - found.point).norm(), 0.0, 1e-12);
    ASSERT_NEAR((q - found.point).norm(), found.distance, 1e-12);
    ASSERT_TRUE(tree.closest_within(q, truth * (1.0 + 1e-9)).has_value());
    ASSERT_FALSE(tree.closest_within(q, truth * (1.0 - 1e-9)).has_value());
  }
}

TEST(AabbTree, ClosestAgreesWithBruteForceOnCleanMeshes) {
  expect_closest_is_right(icosphere(3, 2.0), random_points(300, 4.0, 1));
  expect_closest_is_right(torus(40, 20), random_points(300, 5.0, 2));
  expect_closest_is_right(box({-1, -2, -3}, {1, 2, 3}), random_points(300, 5.0, 3));
}

TEST(AabbTree, ClosestAgreesWithBruteForceOnSoupWithNeedlesAndDegenerates) {
  TriMesh soup;
  soup.points = random_points(603, 3.0, 4);
  for (std::int32_t i = 0; i + 2 < 603; i += 3) soup.triangles.push_back({i, i + 1, i + 2});
  for (std::size_t i = 0; i < 603; i += 9) {  // needles, caps without height, and points
    soup.points[i + 2] = soup.points[i + 1] + 1e-9 * Vec3::UnitX();
    soup.points[i + 5] = 0.3 * soup.points[i + 3] + 0.7 * soup.points[i + 4];
    if (i % 2 == 0) soup.points[i + 8] = soup.points[i + 7] = soup.points[i + 6];
  }
  soup.triangles.push_back({5, 5, 17});
  expect_closest_is_right(soup, random_points(500, 4.0, 5));
}

TEST(AabbTree, QueriesOnTheSurfaceAndFarAway) {
  const TriMesh mesh = icosphere(2);
  const AabbTree tree(mesh);
  for (const Vec3& p : mesh.points) EXPECT_LT(tree.closest(p).distance, 1e-15);
  EXPECT_NEAR(tree.closest({1e6, 2e6, -3e6}).distance, brute_distance(mesh, {1e6, 2e6, -3e6}), 1e-6);
  EXPECT_FALSE(tree.closest_within({5, 0, 0}, 1.0).has_value());
  const TriMesh cube = box({0, 0, 0}, {1, 1, 1});
  EXPECT_TRUE(AabbTree(cube).closest_within({0.25, 0.5, 3.0}, 2.0).has_value());  // exactly at the limit
  EXPECT_FALSE(AabbTree(cube).closest_within({0.25, 0.5, 3.0}, std::nextafter(2.0, 0.0)).has_value());
}

TEST(AabbTree, ManyEqualTrianglesStillBuild) {
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  mesh.triangles.assign(5000, mesh.triangles[0]);
  EXPECT_NEAR(AabbTree(mesh).closest({0, 0, -2}).distance, 2.0, 1e-15);
}

TEST(AabbTree, RaysCrossEachClosedSurfaceOnceInAndOnceOut) {
  const TriMesh mesh = icosphere(3, 2.0);
  const AabbTree tree(mesh);
  const auto ends = random_points(400, 1.1, 6);
  for (std::size_t i = 0; i + 1 < ends.size(); i += 2) {
    const Vec3 direction = (ends[i + 1] - ends[i]).normalized();
    const Vec3 from = ends[i] - 10.0 * direction;
    const double middle = -from.dot(direction);
    const double half = std::sqrt(4.0 - (from + middle * direction).squaredNorm());
    const auto hits = tree.all_hits(from, 3.0 * direction);
    ASSERT_EQ(hits.size(), 2U);
    EXPECT_NEAR(hits[0].t, middle - half, 0.15);
    EXPECT_NEAR(hits[1].t, middle + half, 0.15);
    for (const RayHit& hit : hits) {
      EXPECT_NEAR((hit.point - from - hit.t * direction).norm(), 0.0, 1e-12);
      EXPECT_NEAR(brute_distance(mesh, mesh.triangles[static_cast<std::size_t>(hit.triangle)], hit.point),
                  0.0, 1e-12);
    }
    const auto first = tree.first_hit(from, direction);
    ASSERT_TRUE(first.has_value());
    EXPECT_EQ(first->triangle, hits[0].triangle);
    EXPECT_NEAR(first->t, hits[0].t, 1e-12);
    ASSERT_EQ(tree.all_hits(ends[i], direction).size(), 1U);  // from inside
  }
}

TEST(AabbTree, RaysThroughEdgesAndCornersHitOnce) {
  const TriMesh cube = box({-1, -1, -1}, {1, 1, 1});
  const AabbTree tree(cube);
  for (const Vec3& p : cube.points) {  // through opposite corners
    EXPECT_EQ(tree.all_hits(3.0 * p, -p).size(), 2U);
    EXPECT_EQ(tree.all_hits({0, 0, 0}, p).size(), 1U);
  }
  EXPECT_EQ(tree.all_hits({0, 0, -5}, {0, 0, 1}).size(), 2U);  // through the faces' diagonals
  EXPECT_EQ(tree.all_hits({0, 0, 0}, {1, 0, 1}).size(), 1U);   // through an edge
  EXPECT_NEAR(tree.first_hit({0, 0, 0}, {1, 0, 1})->t, std::sqrt(2.0), 1e-15);

  const TriMesh ball = icosphere(3);
  const AabbTree round(ball);
  for (const Triangle& t : ball.triangles) {
    const Vec3 a = ball.points[static_cast<std::size_t>(t[0])],
               b = ball.points[static_cast<std::size_t>(t[1])];
    ASSERT_EQ(round.all_hits({0, 0, 0}, a).size(), 1U);
    ASSERT_EQ(round.all_hits({0, 0, 0}, 0.5 * (a + b)).size(), 1U);
  }
}

TEST(AabbTree, RaysThatMiss) {
  const AabbTree tree(box({-1, -1, -1}, {1, 1, 1}));
  EXPECT_FALSE(tree.first_hit({0, 0, 5}, {0, 0, 1}).has_value());
  EXPECT_TRUE(tree.all_hits({5, 5, 5}, {1, -1, 0}).empty());
}

TEST(AabbTree, SignedDistanceOfASphere) {
  const AabbTree tree(icosphere(5, 2.0, {1, 2, 3}));
  for (const Vec3& q : random_points(2000, 4.0, 7)) {
    const double truth = (q - Vec3(1, 2, 3)).norm() - 2.0;
    ASSERT_NEAR(tree.signed_distance(q), truth, 1.5e-3);
    if (std::abs(truth) > 2e-3) {
      ASSERT_EQ(tree.inside(q), truth < 0.0);
    }
  }
}

TEST(AabbTree, SignOfATorusNearAndFar) {
  const AabbTree tree(torus(200, 100));
  for (const Vec3& q : random_points(2000, 5.0, 8)) {
    const double truth = std::hypot(std::hypot(q.x(), q.y()) - 3.0, q.z()) - 1.0;
    ASSERT_NEAR(tree.signed_distance(q), truth, 3e-3);
  }
}

TEST(AabbTree, RefusesBadInput) {
  EXPECT_THROW(AabbTree(TriMesh{}), InvalidInput);
  TriMesh mesh = box({0, 0, 0}, {1, 1, 1});
  const AabbTree tree(mesh);
  EXPECT_THROW(tree.closest({nan, 0, 0}), InvalidInput);
  EXPECT_THROW(tree.closest_within({0, 0, 0}, -1.0), InvalidInput);
  EXPECT_THROW(tree.first_hit({0, 0, 0}, {0, 0, 0}), InvalidInput);
  EXPECT_THROW(tree.all_hits({0, 0, 0}, {nan, 0, 0}), InvalidInput);
  EXPECT_THROW(tree.winding_number({nan, 0, 0}), InvalidInput);
  mesh.points[3].x() = nan;
  EXPECT_THROW(AabbTree{mesh}, InvalidInput);
  mesh.points[3].x() = 0.0;
  mesh.triangles[0][0] = 8;
  EXPECT_THROW(AabbTree{mesh}, InvalidInput);
}

}  // namespace
}  // namespace ostia::geometry
