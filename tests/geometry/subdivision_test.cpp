#include "ostia/geometry/subdivision.h"

#include "test_meshes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::geometry {
namespace {

TriMesh octahedron() {
  return {{{1, 0, 0}, {-1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
          {{0, 2, 4}, {2, 1, 4}, {1, 3, 4}, {3, 0, 4}, {2, 0, 5}, {1, 2, 5}, {3, 1, 5}, {0, 3, 5}}};
}

/// A torus of `n` by `n` quadrilaterals cut in two: every point has six neighbours.
TriMesh regular_torus(std::int32_t n, double ring, double radius) {
  TriMesh mesh;
  const double step = 2.0 * std::numbers::pi / n;
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < n; ++j) {
      const double away = ring + radius * std::cos(step * j);
      mesh.points.emplace_back(away * std::cos(step * i), away * std::sin(step * i),
                               radius * std::sin(step * j));
    }
  const auto at = [&](std::int32_t i, std::int32_t j) { return (i % n) * n + j % n; };
  for (std::int32_t i = 0; i < n; ++i)
    for (std::int32_t j = 0; j < n; ++j) {
      mesh.triangles.push_back({at(i, j), at(i + 1, j), at(i + 1, j + 1)});
      mesh.triangles.push_back({at(i, j), at(i + 1, j + 1), at(i, j + 1)});
    }
  return mesh;
}

SubdivisionOptions levels(int n, bool to_limit = false) {
  SubdivisionOptions options;
  options.levels = n;
  options.to_limit = to_limit;
  return options;
}

TEST(Subdivision, OctahedronGoesToItsKnownLimit) {
  // Of valence 4: w = (5/8 - 9/64) / 4 and, by the scheme's eigenvector, 1 / (3 / (8 w) + 4) a neighbour; the
  // neighbours of a tip cancel out.
  const double w = (0.625 - 9.0 / 64.0) / 4.0;
  const double limit = 1.0 - 4.0 / (0.375 / w + 4.0);
  for (const int n : {0, 1, 3}) {
    const TriMesh fine = loop_subdivided(octahedron(), levels(n, true));
    EXPECT_NEAR((fine.points[4] - Vec3(0, 0, limit)).norm(), 0.0, 1e-12) << n;
  }
  const TriMesh near = loop_subdivided(octahedron(), levels(6));
  EXPECT_NEAR((near.points[4] - Vec3(0, 0, limit)).norm(), 0.0, 1e-4);
  const SurfaceFaults faults = find_faults(near, false);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  EXPECT_EQ(near.triangles.size(), 8u * 4096u);
  EXPECT_GT(volume(near), 0.0);
}

TEST(Subdivision, LimitDoesNotDependOnTheLevel) {
  const TriMesh torus = regular_torus(12, 3.0, 1.0);
  const TriMesh coarse = loop_subdivided(torus, levels(0, true)),
                fine = loop_subdivided(torus, levels(3, true));
  for (std::size_t i = 0; i < torus.points.size(); ++i)
    EXPECT_LT((coarse.points[i] - fine.points[i]).norm(), 1e-12);
}

TEST(Subdivision, TorusOfManyPointsStaysWhereItIs) {
  // The limit misses a point by about a twelfth of the sum of its neighbours' offsets, of second order.
  double before = 0.0;
  for (const std::int32_t n : {24, 48}) {
    const TriMesh fine = loop_subdivided(regular_torus(n, 3.0, 1.0), levels(2, true));
    double worst = 0.0;
    for (const Vec3& p : fine.points)
      worst = std::max(worst, std::abs(std::hypot(p.head<2>().norm() - 3.0, p.z()) - 1.0));
    if (before > 0.0) {
      EXPECT_NEAR(before / worst, 4.0, 0.4);
    }
    before = worst;
    EXPECT_NEAR(volume(fine), 2.0 * std::numbers::pi * std::numbers::pi * 3.0, 60.0 * worst);
    EXPECT_LT(worst, 0.06);
  }
}

TEST(Subdivision, SphereShrinksByItsEdgesSquareOverFourRadii) {
  const TriMesh sphere = test::icosphere(4, 2.0), limit = loop_subdivided(sphere, levels(0, true));
  double radius = 0.0;
  for (const Vec3& p : limit.points) radius += p.norm() / static_cast<double>(limit.points.size());
  // Equilateral triangles: the area is sqrt(3) / 4 h^2 each.
  const double edge2 = area(sphere) / static_cast<double>(sphere.triangles.size()) * 4.0 / std::sqrt(3.0);
  EXPECT_NEAR(2.0 - radius, edge2 / (4.0 * 2.0), 0.1 * edge2 / 8.0);
}

TEST(Subdivision, BorderOfATubeIsASplineOfItsOwn) {
  const int around = 16;
  TriMesh tube = test::tube(around, 5);
  const TriMesh fine = loop_subdivided(tube, levels(2));
  EXPECT_EQ(fine.triangles.size(), 16 * tube.triangles.size());
  const auto loops = boundary_loops(fine);
  ASSERT_EQ(loops.size(), 2u);
  EXPECT_EQ(loops[0].size(), 4u * around);
  // Flat ends stay flat, and all their points are moved inward alike.
  const TriMesh limit = loop_subdivided(tube, levels(2, true));
  const double spline = (4.0 + 2.0 * std::cos(2.0 * std::numbers::pi / around)) / 6.0;
  for (int i = 0; i < around; ++i) {
    EXPECT_NEAR(limit.points[static_cast<std::size_t>(i)].z(), 0.0, 1e-12);
    EXPECT_NEAR(limit.points[static_cast<std::size_t>(i)].head<2>().norm(), spline, 1e-12);
  }
  // What lies inside does not move the border.
  for (std::size_t p = static_cast<std::size_t>(around); p < tube.points.size() - around; ++p)
    tube.points[p] *= 1.5;
  const TriMesh other = loop_subdivided(tube, levels(2, true));
  for (int i = 0; i < around; ++i)
    EXPECT_EQ(other.points[static_cast<std::size_t>(i)], limit.points[static_cast<std::size_t>(i)]);
}

TEST(Subdivision, ChildrenComeFourByFour) {
  const TriMesh fine = loop_subdivided(octahedron(), levels(1));
  for (std::size_t t = 0; t < 8; ++t)
    for (std::size_t i = 0; i < 3; ++i) EXPECT_EQ(fine.triangles[4 * t + i][0], octahedron().triangles[t][i]);
}

TEST(Subdivision, RefusesBadInput) {
  EXPECT_THROW(loop_subdivided(octahedron(), levels(-1)), InvalidInput);
  EXPECT_THROW(loop_subdivided(octahedron(), levels(9)), InvalidInput);
  SubdivisionOptions small = levels(3);
  small.max_triangles = 511;
  EXPECT_THROW(loop_subdivided(octahedron(), small), InvalidInput);
  small.max_triangles = 512;
  EXPECT_EQ(loop_subdivided(octahedron(), small).triangles.size(), 512u);
  TriMesh flap = octahedron();
  flap.points.emplace_back(2, 2, 2);
  flap.triangles.push_back({0, 2, 6});
  EXPECT_THROW(loop_subdivided(flap, levels(1)), GeometryError);
  TriMesh turned = octahedron();
  std::swap(turned.triangles[0][0], turned.triangles[0][1]);
  EXPECT_THROW(loop_subdivided(turned, levels(1)), GeometryError);
  TriMesh tie{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {-1, 0, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 3, 4}}};
  EXPECT_THROW(loop_subdivided(tie, levels(1)), GeometryError);
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(loop_subdivided(octahedron(), levels(2), task), Cancelled);
}

}  // namespace
}  // namespace ostia::geometry
