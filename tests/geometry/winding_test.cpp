#include "winding.h"

#include "test_meshes.h"

#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

using test::icosphere;
using test::random_points;
using test::torus;
using test::tube;

/// The sum over all triangles, without a tree.
double exact_winding(const TriMesh& mesh, const Vec3& q) {
  double sum = 0.0;
  for (const Triangle& t : mesh.triangles) {
    const Vec3 a = mesh.points[static_cast<std::size_t>(t[0])] - q,
               b = mesh.points[static_cast<std::size_t>(t[1])] - q,
               c = mesh.points[static_cast<std::size_t>(t[2])] - q;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (2.0 * std::numbers::pi);
}

TEST(Winding, OneInsideZeroOutside) {
  const AabbTree tree(icosphere(5));
  for (const Vec3& q : random_points(500, 2.0, 1)) {
    if (std::abs(q.norm() - 1.0) < 2e-3) continue;
    ASSERT_NEAR(tree.winding_number(q), q.norm() < 1.0 ? 1.0 : 0.0, 5e-3);
  }
  TriMesh inward = icosphere(3);
  test::turn_over(inward);
  EXPECT_NEAR(AabbTree(inward).winding_number({0.1, 0.2, 0.3}), -1.0, 5e-3);
}

TEST(Winding, ExpansionAgreesWithTheExactSum) {
  for (const TriMesh& mesh : {torus(120, 60), tube(60, 80, 1.0, 12.0)}) {
    const AabbTree tree(mesh);
    double worst = 0.0;
    for (const Vec3& q : random_points(400, 5.0, 2)) {
      worst = std::max(worst, std::abs(tree.winding_number(q) - exact_winding(mesh, q)));
    }
    EXPECT_LT(worst, 5e-3);
    EXPECT_GT(worst, 0.0);  // the expansion was in use at all
  }
}

TEST(Winding, HoleCostsOnlyItsSolidAngle) {
  // A spherical cap of half angle h seen from the middle takes (1 - cos h) / 2 of the whole.
  const TriMesh whole = icosphere(5);
  std::vector<bool> keep;
  for (const Triangle& t : whole.triangles) {
    double lowest = 2.0;
    for (const std::int32_t p : t) lowest = std::min(lowest, whole.points[static_cast<std::size_t>(p)].z());
    keep.push_back(lowest < std::cos(0.3));
  }
  const AabbTree tree(subset(whole, keep));
  EXPECT_NEAR(tree.winding_number({0, 0, 0}), 1.0 - (1.0 - std::cos(0.3)) / 2.0, 6e-3);
  for (const Vec3& q : random_points(300, 1.5, 3)) {
    if (std::abs(q.norm() - 1.0) < 0.02 || (q - Vec3(0, 0, 1)).norm() < 0.6) continue;
    ASSERT_EQ(tree.inside(q), q.norm() < 1.0);
  }
}

TEST(Winding, NeedlesDegeneratesAndOverlapsDoNotFlipTheSign) {
  TriMesh mesh = icosphere(4);
  const auto count = static_cast<std::int32_t>(mesh.points.size());
  for (std::int32_t i = 0; i < 200;
       ++i) {  // needles across the inside, each with its opposite twin; and points
    mesh.triangles.push_back({i, (i * 7 + 31) % count, i});
    mesh.triangles.push_back({i, (i * 7 + 31) % count, (i * 13 + 5) % count});
    mesh.triangles.push_back({i, (i * 13 + 5) % count, (i * 7 + 31) % count});
  }
  const AabbTree tree(mesh);
  for (const Vec3& q : random_points(500, 1.6, 4)) {
    if (std::abs(q.norm() - 1.0) < 0.01) continue;
    ASSERT_EQ(tree.inside(q), q.norm() < 1.0);
  }
  const AabbTree two(merged(icosphere(4), icosphere(4, 1.0, {0.5, 0, 0})));
  EXPECT_NEAR(two.winding_number({0.25, 0, 0}), 2.0, 1e-2);
  EXPECT_TRUE(two.inside({0.25, 0, 0}));
  EXPECT_FALSE(two.inside({0.25, 1.2, 0}));
}

TEST(Winding, HalfOnTheSurfaceAndFiniteAtCorners) {
  const TriMesh mesh = test::box({-1, -1, -1}, {1, 1, 1});
  const AabbTree tree(mesh);
  for (const Vec3& p : mesh.points) EXPECT_TRUE(std::isfinite(tree.winding_number(p)));
  EXPECT_NEAR(tree.winding_number({0.3, 0.2, 1.0 + 1e-9}), 0.0, 1e-6);
  EXPECT_NEAR(tree.winding_number({0.3, 0.2, 1.0 - 1e-9}), 1.0, 1e-6);
}

}  // namespace
}  // namespace ostia::geometry
