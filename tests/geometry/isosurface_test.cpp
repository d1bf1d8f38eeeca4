#include "ostia/geometry/isosurface.h"

#include "surface_checks.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>
#include <random>

namespace ostia::geometry {
namespace {

using std::numbers::pi;
using test::expect_closed_manifold;
using test::topology_of;

struct Samples {
  ScalarGrid grid;
  std::vector<float> values;
  template <class F>
  Samples(std::array<std::int64_t, 3> size, const Vec3& origin, const Mat3& axes, const F& f) {
    grid.size = size;
    grid.origin = origin;
    grid.axes = axes;
    for (std::int64_t k = 0; k < size[2]; ++k) {
      for (std::int64_t j = 0; j < size[1]; ++j) {
        for (std::int64_t i = 0; i < size[0]; ++i) {
          const Vec3 index(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
          values.push_back(static_cast<float>(f(Vec3(origin + axes * index))));
        }
      }
    }
    grid.values = values.data();
  }
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
};

double sphere(const Vec3& p) {
  return p.norm() - 5.0;
}
double torus_field(const Vec3& p) {
  return std::hypot(std::hypot(p.x(), p.y()) - 6.0, p.z()) - 2.0;
}

TEST(Isosurface, SphereIsClosedOutwardAndOfSecondOrder) {
  double error[2], volume[2];
  for (int i = 0; i < 2; ++i) {
    const double h = i == 0 ? 0.5 : 0.25;
    const TriMesh mesh = isosurface(sphere, Box3(Vec3::Constant(-6.1), Vec3::Constant(6.1)), h);
    expect_closed_manifold(mesh, 2);
    error[i] = 0.0;
    for (const Vec3& p : mesh.points) error[i] = std::max(error[i], std::abs(sphere(p)));
    volume[i] = std::abs(test::volume_of(mesh) - 4.0 / 3.0 * pi * 125.0);
    EXPECT_GT(test::volume_of(mesh), 0.0);
    EXPECT_NEAR(test::area_of(mesh), 4.0 * pi * 25.0, 4.0 * h * h);
  }
  EXPECT_LT(error[1], 0.25 * 0.25 / 8.0 / 5.0 * 3.0);  // h^2 / 8 times the curvature, for a diagonal
  EXPECT_GT(volume[0] / volume[1], 3.5);
}

TEST(Isosurface, TorusHasAHole) {
  const TriMesh mesh = isosurface(torus_field, Box3(Vec3(-9, -9, -3), Vec3(9, 9, 3)), 0.4);
  expect_closed_manifold(mesh, 0);
  EXPECT_NEAR(test::volume_of(mesh), 2.0 * pi * pi * 6.0 * 4.0, 5.0);
}

TEST(Isosurface, ShellIsTwoClosedSurfacesFacingApart) {
  const auto shell = [](const Vec3& p) { return std::abs(p.norm() - 4.0) - 1.0; };
  const TriMesh mesh = isosurface(shell, Box3(Vec3::Constant(-6), Vec3::Constant(6)), 0.3);
  expect_closed_manifold(mesh, 4);
  EXPECT_NEAR(test::volume_of(mesh), 4.0 / 3.0 * pi * (125.0 - 27.0), 4.0);
}

TEST(Isosurface, NoiseIsClosedManifoldAndOriented) {
  // Every one of the 256 patterns and every ambiguous face occurs many times; only consistency keeps it
  // closed.
  for (unsigned seed = 0; seed < 3; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Samples s({24, 21, 27}, Vec3::Zero(), Mat3::Identity(), [&](const Vec3&) { return unit(random); });
    const TriMesh mesh = isosurface(s.grid, 0.0f, true);
    ASSERT_GT(mesh.triangles.size(), 20000u);
    const test::Topology t = topology_of(mesh);
    EXPECT_EQ(t.repeated_half_edges, 0u);
    EXPECT_EQ(t.border_half_edges, 0u);
    EXPECT_EQ(t.pinched_vertices, 0u);
    EXPECT_GT(t.smallest_area, 0.0);
    EXPECT_EQ(t.euler % 2, 0);
    EXPECT_GT(test::volume_of(mesh), 0.0);
  }
}

TEST(Isosurface, RandomMasksWithValuesOnTheLevelAreManifoldToo) {
  std::mt19937 random(3);
  const Samples s({20, 20, 20}, Vec3::Zero(), Mat3::Identity(),
                  [&](const Vec3&) { return static_cast<double>(random() % 3) - 1.0; });
  const TriMesh mesh = isosurface(s.grid, 0.0f, true);  // a third of the values are exactly on the level
  const test::Topology t = topology_of(mesh);
  EXPECT_EQ(t.repeated_half_edges, 0u);
  EXPECT_EQ(t.border_half_edges, 0u);
  EXPECT_EQ(t.pinched_vertices, 0u);
  EXPECT_GT(t.smallest_area, 0.0);
}

TEST(Isosurface, NoiseDoesNotCrossItself) {
  // On oblique anisotropic axes; values are near the nodes' on purpose, where triangles are thinnest.
  for (unsigned seed = 0; seed < 4; ++seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1.0, 1.0);
    const Mat3 axes = Eigen::AngleAxisd(0.7, Vec3(1, 2, 3).normalized()).toRotationMatrix() *
                      Vec3(0.69, 0.69, 1.25).asDiagonal();
    const Samples s({32, 32, 32}, Vec3(-141.3, 97.1, -210.4), axes, [&](const Vec3&) {
      const double v = unit(random);
      return seed < 2 ? v : v * v * v * v * v;
    });
    EXPECT_TRUE(self_intersections(isosurface(s.grid, 0.0f, true), 1).empty());
  }
}

TEST(Isosurface, OneDiagonalPairOfVoxelsIsSeparated) {
  // Inside corners at a face's diagonal are kept apart, whatever the values.
  Samples s({2, 2, 1}, Vec3::Zero(), Mat3::Identity(),
            [](const Vec3& p) { return p.x() == p.y() ? -1.0 : 0.1; });
  expect_closed_manifold(isosurface(s.grid, 0.0f, true), 4);
  for (float& v : s.values) v = -v;
  expect_closed_manifold(isosurface(s.grid, 0.0f, true), 4);
}

TEST(Isosurface, SheetsThatNearlyTouchDoNotShareEdges) {
  // Two blobs meet at a saddle between nodes; the ambiguous face there must not make an edge of four
  // triangles.
  const auto blobs = [](const Vec3& p) {
    return std::min((p - Vec3(-2.05, 0.03, 0)).norm(), (p - Vec3(2.02, 0, 0.07)).norm()) - 2.01;
  };
  const TriMesh mesh = isosurface(blobs, Box3(Vec3::Constant(-5), Vec3::Constant(5)), 0.31);
  const test::Topology t = topology_of(mesh);
  EXPECT_EQ(t.repeated_half_edges + t.border_half_edges + t.pinched_vertices, 0u);
}

TEST(Isosurface, ObliqueAndLeftHandedAxesKeepPlaceAndOrientation) {
  Mat3 axes = Eigen::AngleAxisd(0.4, Vec3(1, 2, 3).normalized()).toRotationMatrix() * 0.4;
  axes.col(2) *= -1.3;  // left-handed, uneven
  ASSERT_LT(axes.determinant(), 0.0);
  const Vec3 origin = -axes * Vec3(18, 18, 14);
  const Samples s({37, 37, 29}, origin, axes, sphere);
  const TriMesh mesh = isosurface(s.grid, 0.0f, false);
  expect_closed_manifold(mesh, 2);
  EXPECT_NEAR(test::volume_of(mesh), 4.0 / 3.0 * pi * 125.0, 6.0);
  for (const Vec3& p : mesh.points) ASSERT_NEAR(p.norm(), 5.0, 0.03);
}

TEST(Isosurface, BorderIsOpenUnlessClosed) {
  // A cylinder through the whole grid: open at two ends, or closed half a voxel beyond the last slices.
  const Samples s({21, 21, 11}, Vec3(-10, -10, 0), Mat3::Identity(),
                  [](const Vec3& p) { return std::hypot(p.x(), p.y()) - 7.3; });
  const test::Topology open = topology_of(isosurface(s.grid, 0.0f, false));
  EXPECT_EQ(open.border_loops, 2u);
  EXPECT_EQ(open.repeated_half_edges, 0u);
  EXPECT_EQ(open.euler, 0);
  const TriMesh closed = isosurface(s.grid, 0.0f, true);
  expect_closed_manifold(closed, 2);
  double low = 1e9, high = -1e9;
  for (const Vec3& p : closed.points) {
    low = std::min(low, p.z());
    high = std::max(high, p.z());
  }
  EXPECT_DOUBLE_EQ(low, -0.5);
  EXPECT_DOUBLE_EQ(high, 10.5);
}

TEST(Isosurface, GridAllInsideClosesAsABox) {
  const Samples s({3, 1, 1}, Vec3::Zero(), Mat3::Identity(), [](const Vec3&) { return -1.0; });
  const TriMesh mesh = isosurface(s.grid, 0.0f, true);
  expect_closed_manifold(mesh, 2);
  EXPECT_TRUE(isosurface(s.grid, 0.0f, false).triangles.empty());
}

TEST(Isosurface, NothingCrossesNothingComes) {
  const Samples s({8, 8, 8}, Vec3::Zero(), Mat3::Identity(), [](const Vec3&) { return 1.0; });
  EXPECT_TRUE(isosurface(s.grid, 0.0f, true).points.empty());
  EXPECT_TRUE(isosurface(s.grid, 0.0f, false).points.empty());
}

TEST(Isosurface, LevelIsWhereItIsAsked) {
  const Samples s({31, 31, 31}, Vec3::Constant(-7.5), Mat3::Identity() * 0.5,
                  [](const Vec3& p) { return p.norm(); });
  for (const float level : {2.0f, 6.0f}) {
    for (const Vec3& p : isosurface(s.grid, level, false).points) ASSERT_NEAR(p.norm(), level, 0.03);
  }
}

TEST(Isosurface, SameForAnyNumberOfThreads) {
  std::mt19937 random(11);
  const Samples s({15, 17, 60}, Vec3::Zero(), Mat3::Identity(),
                  [&](const Vec3&) { return static_cast<double>(random()) / 2e9 - 1.0; });
  const TriMesh all = isosurface(s.grid, 0.0f, true);
  core::set_max_threads(1);
  const TriMesh one = isosurface(s.grid, 0.0f, true);
  core::set_max_threads(0);
  EXPECT_EQ(one.points, all.points);
  EXPECT_EQ(one.triangles, all.triangles);
}

TEST(Isosurface, EveryPointIsUsedAndThereOnce) {
  const TriMesh mesh = isosurface(torus_field, Box3(Vec3(-9, -9, -3), Vec3(9, 9, 3)), 0.5);
  std::vector<bool> used(mesh.points.size(), false);
  for (const Triangle& t : mesh.triangles) {
    for (const std::int32_t v : t) used[static_cast<std::size_t>(v)] = true;
  }
  EXPECT_EQ(std::count(used.begin(), used.end(), false), 0);
}

TEST(Isosurface, InfiniteValuesAreFarOutsideOrInside) {
  Samples s({9, 9, 9}, Vec3::Constant(-4), Mat3::Identity(), [](const Vec3& p) { return p.norm() - 2.5; });
  const float inf = std::numeric_limits<float>::infinity();
  for (float& v : s.values) v = v < 0.0f ? -inf : inf;
  const TriMesh mesh = isosurface(s.grid, 0.0f, false);
  expect_closed_manifold(mesh, 2);
  for (const Vec3& p : mesh.points) ASSERT_TRUE(p.allFinite());
}

TEST(Isosurface, RefusesBadInput) {
  Samples s({6, 6, 20}, Vec3::Zero(), Mat3::Identity(), [](const Vec3& p) { return p.z() - 3.5; });
  s.values[6 * 6 * 15 + 7] = std::numeric_limits<float>::quiet_NaN();
  try {
    isosurface(s.grid, 0.0f, false);
    FAIL() << "a NaN was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("1,1,15"), std::string::npos) << error.what();
  }
  try {
    isosurface(s.grid, 0.0f, true);
    FAIL() << "a NaN was accepted";
  } catch (const InvalidInput& error) {
    EXPECT_NE(std::string(error.what()).find("1,1,15"), std::string::npos) << error.what();
  }
  s.values[6 * 6 * 15 + 7] = 0.0f;
  EXPECT_THROW(isosurface(s.grid, std::numeric_limits<float>::quiet_NaN(), false), InvalidInput);
  s.grid.axes.col(1) = s.grid.axes.col(0);
  EXPECT_THROW(isosurface(s.grid, 0.0f, false), InvalidInput);
  ScalarGrid empty;
  EXPECT_THROW(isosurface(empty, 0.0f, false), InvalidInput);
  const Box3 box(Vec3::Zero(), Vec3::Ones());
  EXPECT_THROW(isosurface(sphere, box, 0.0), InvalidInput);
  EXPECT_THROW(isosurface(sphere, Box3(), 0.1), InvalidInput);
}

TEST(Isosurface, CanBeCancelledAndReportsProgress) {
  const Samples s({20, 20, 40}, Vec3::Constant(-10), Mat3::Identity(), sphere);
  const core::TaskContext done;
  isosurface(s.grid, 0.0f, false, done);
  EXPECT_DOUBLE_EQ(done.progress(), 1.0);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(isosurface(s.grid, 0.0f, false, task), Cancelled);
}

}  // namespace
}  // namespace ostia::geometry
