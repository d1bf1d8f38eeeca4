#include "test_surfaces.h"
#include "tetrahedra/mending.h"
#include "tetrahedra/quality.h"
#include "tetrahedra_samples.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/quality.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace ostia::meshing {
namespace {

using geometry::Vec3;
using geometry::VolumeMesh;

/// A regular tetrahedron cut into four by a point inside.
VolumeMesh four_tetrahedra(const Vec3& inner) {
  const auto surface = tetrahedron_surface(1.0);
  VolumeMesh mesh;
  mesh.points = surface.points;
  mesh.points.push_back(inner);
  for (const auto& t : surface.triangles) mesh.tetrahedra.push_back({t[0], t[2], t[1], 4});
  take_boundary(mesh);
  return mesh;
}

double least_quality(const VolumeMesh& mesh) {
  double least = 1.0;
  const auto at = [&](std::int32_t v) { return mesh.points[static_cast<std::size_t>(v)]; };
  for (const auto& t : mesh.tetrahedra)
    least = std::min(least, tetrahedron_quality(at(t[0]), at(t[1]), at(t[2]), at(t[3])));
  return least;
}

TEST(TetrahedronQuality, IsThatOfKnownAngles) {
  const auto regular = tetrahedron_surface(2.0).points;
  EXPECT_NEAR(tetrahedron_quality(regular[0], regular[1], regular[2], regular[3]), 2.0 / 3.0, 1e-12);
  // The corner of a cube: three right angles, and three of acos(1 / sqrt(3)).
  const Vec3 o(0, 0, 0), x(1, 0, 0), y(0, 1, 0), z(0, 0, 1);
  EXPECT_NEAR(tetrahedron_quality(o, x, y, z), 1.0 - 1.0 / std::numbers::sqrt3, 1e-12);
  EXPECT_NEAR(tetrahedron_quality(o, y, x, z), -1.0, 1e-12);  // inside out: six volumes
  // A flat one on a square: its least angle by the measure of the gate.
  const Vec3 a(1, 0, 0.1), b(-1, 0, 0.1), c(0, 1, -0.1), d(0, -1, -0.1);
  const double largest = dihedral_range_deg(a, b, c, d)[1] * std::numbers::pi / 180.0;
  EXPECT_NEAR(tetrahedron_quality(a, b, c, d), large_angle_weight * (1.0 + std::cos(largest)), 1e-12);
  EXPECT_NEAR(quality_of_angle(60.0), 0.5, 1e-12);
}

TEST(TetrahedraMending, CentresAPointThatStandsTooNearAFace) {
  auto mesh = four_tetrahedra({-0.095, -0.10, -0.09});
  ASSERT_EQ(volume_quality(mesh).inverted, 0u);
  const double before = volume_quality(mesh).min_dihedral_deg;
  ASSERT_LT(before, 15.0);
  const VolumeMesh old = mesh;
  MendingOptions options;
  options.goal_deg = 40.0;
  mend_tetrahedra(mesh, options);
  EXPECT_GT(volume_quality(mesh).min_dihedral_deg, before + 10.0);
  expect_sound(mesh, old);
}

TEST(TetrahedraMending, RightsAnInvertedTetrahedron) {
  auto mesh = four_tetrahedra({-0.15, -0.15, -0.14});
  ASSERT_GT(volume_quality(mesh).inverted, 0u);
  mend_tetrahedra(mesh, {20.0, 30, 0.0});
  EXPECT_EQ(volume_quality(mesh).inverted, 0u);
}

/// Two pyramids of height h on a square, cut into four around one of its three diagonals.
VolumeMesh octahedron(double height, bool around_the_long_one) {
  VolumeMesh mesh;
  mesh.points = {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, height}, {0, 0, -height}};
  if (around_the_long_one) {
    for (std::int32_t i = 0; i < 4; ++i) mesh.tetrahedra.push_back({5, 4, i, (i + 1) % 4});
  } else {  // around 0-2
    const std::int32_t ring[] = {1, 4, 3, 5};
    for (std::size_t i = 0; i < 4; ++i) mesh.tetrahedra.push_back({2, 0, ring[i], ring[(i + 1) % 4]});
  }
  take_boundary(mesh);
  return mesh;
}

TEST(TetrahedraMending, FlipsAnOctahedronThatIsSplitTheWrongWay) {
  // Around a diagonal of the square the least angle of a flat octahedron is atan(h), and around the short
  // axis 45 degrees and more: the 4-4 flip must find it.
  VolumeMesh mesh = octahedron(0.2, false);
  ASSERT_EQ(volume_quality(mesh).inverted, 0u);
  const VolumeMesh good = octahedron(0.2, true), old = mesh;
  ASSERT_LT(least_quality(mesh), least_quality(good));
  MendingOptions options;
  options.goal_deg = 30.0;
  const MendingReport report = mend_tetrahedra(mesh, options);
  EXPECT_GE(report.flips, 1u);
  EXPECT_EQ(report.points_moved, 0u);
  EXPECT_EQ(mesh.tetrahedra.size(), 4u);
  EXPECT_NEAR(least_quality(mesh), least_quality(good), 1e-12);
  EXPECT_NEAR(volume_quality(mesh).min_dihedral_deg, volume_quality(good).min_dihedral_deg, 1e-9);
  expect_sound(mesh, old);
}

TEST(TetrahedraMending, ExchangesThreeAroundAnEdgeForTwoAndBack) {
  // A bipyramid on an equilateral triangle: with a long axis two tetrahedra are better, with a short one
  // three.
  for (const bool high : {true, false}) {
    const double h = high ? 1.5 : 0.25;
    VolumeMesh mesh;
    for (const double angle : {0.0, 2.0, 4.0})
      mesh.points.emplace_back(std::cos(angle * std::numbers::pi / 3.0),
                               std::sin(angle * std::numbers::pi / 3.0), 0.0);
    mesh.points.emplace_back(0, 0, h);
    mesh.points.emplace_back(0, 0, -h);
    if (high)
      mesh.tetrahedra = {{4, 3, 0, 1}, {4, 3, 1, 2}, {4, 3, 2, 0}};
    else
      mesh.tetrahedra = {{0, 1, 2, 3}, {0, 2, 1, 4}};
    take_boundary(mesh);
    const VolumeMesh old = mesh;
    ASSERT_EQ(volume_quality(mesh).inverted, 0u);
    const MendingReport report = mend_tetrahedra(mesh, {high ? 60.0 : 28.0, 4, 0.0});
    EXPECT_EQ(report.flips, 1u) << high;
    EXPECT_EQ(mesh.tetrahedra.size(), high ? 2u : 3u);
    expect_sound(mesh, old);
  }
}

TEST(TetrahedraMending, RemovesASliverBetweenFourPointsOfTheSurface) {
  // A box whose top has two triangles that are not Delaunay and a flat tetrahedron below them: points cannot
  // move, since all are on the surface.
  VolumeMesh mesh = flat_tetrahedron_under_a_roof();
  const VolumeMesh old = mesh;
  ASSERT_EQ(volume_quality(mesh).inverted, 0u);
  const double before = volume_quality(mesh).min_dihedral_deg;
  ASSERT_LT(before, 6.0);
  const MendingReport report = mend_tetrahedra(mesh, {18.0, 8, 1.0});
  EXPECT_GT(volume_quality(mesh).min_dihedral_deg, 10.0);
  EXPECT_GE(report.flips + report.points_added, 1u);
  expect_sound(mesh, old);
}

TEST(TetrahedraMending, TellsOfAWedgeThatTheSurfaceItselfMakes) {
  // One tetrahedron: all its angles are the surface's.
  VolumeMesh mesh;
  mesh.points = {{0, 0, 0}, {1, 0, 0}, {0.5, 1, 0.05}, {0.5, 1, -0.05}};
  mesh.tetrahedra = {{0, 1, 3, 2}};
  take_boundary(mesh);
  const VolumeMesh old = mesh;
  const MendingReport report = mend_tetrahedra(mesh, {});
  EXPECT_EQ(report.below_goal, 1u);
  EXPECT_EQ(report.held_by_surface, 1u);
  EXPECT_NEAR(report.least_held_deg, 2.0 * std::atan(0.05) * 180.0 / std::numbers::pi, 1e-9);
  EXPECT_NEAR((report.held_place - Vec3(0.5, 0.5, 0.0)).norm(), 0.0, 1e-12);
  expect_sound(mesh, old);
}

TEST(TetrahedraMending, NeverMakesARandomMeshWorseAndIsRepeatable) {
  for (const unsigned seed : {1u, 2u, 3u}) {
    const VolumeMesh old = random_box(6, seed);
    ASSERT_EQ(volume_quality(old).inverted, 0u);
    VolumeMesh mesh = old, again = old;
    const MendingOptions options{25.0, 4, 0.05};
    const MendingReport report = mend_tetrahedra(mesh, options);
    mend_tetrahedra(again, options);
    EXPECT_EQ(mesh.points, again.points);
    EXPECT_EQ(mesh.tetrahedra, again.tetrahedra);
    EXPECT_GE(least_quality(mesh), least_quality(old));
    EXPECT_GT(report.flips, 0u);
    EXPECT_GT(report.points_moved, 0u);
    const auto bad = [](const VolumeMesh& m) {
      const auto histogram = volume_quality(m).min_dihedral_histogram;
      return histogram[0] + histogram[1];
    };
    EXPECT_LT(5 * bad(mesh), bad(old)) << seed;
    EXPECT_LE(static_cast<double>(mesh.tetrahedra.size()),
              1.05 * static_cast<double>(old.tetrahedra.size()) + 60);
    expect_sound(mesh, old);
  }
}

TEST(TetrahedraMending, LeavesGoodMeshesAndObeysCancel) {
  auto mesh = four_tetrahedra({0.0, 0.0, 0.0});
  const VolumeMesh old = mesh;
  const MendingReport report = mend_tetrahedra(mesh, {20.0, 5, 0.02});
  EXPECT_EQ(report.points_moved + report.flips + report.points_added + report.points_removed, 0u);
  EXPECT_EQ(mesh.points, old.points);
  EXPECT_EQ(mesh.tetrahedra, old.tetrahedra);
  mesh = four_tetrahedra({-0.095, -0.10, -0.09});
  const VolumeMesh untouched = mesh;
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(mend_tetrahedra(mesh, {40.0, 5, 0.02}, task), Cancelled);
  EXPECT_EQ(mesh.points, untouched.points);
}

}  // namespace
}  // namespace ostia::meshing
