#include "ostia/figure/cut_open.h"

#include "test_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace ostia::figure {
namespace {

TEST(CutOpen, ABoxCutBetweenItsLayersShowsOneFlatFace) {
  const auto mesh = tetrahedral_box(3, 4, 5);
  const CutMesh cut = cut_open(mesh, {{0, 0, 2.0}, {0, 0, 1}});
  EXPECT_NEAR(geometry::area(cut.interior), 12.0, 1e-12);
  EXPECT_NEAR(geometry::area(cut.boundary), 12.0 + 2 * (3.0 + 4.0) * 2.0, 1e-12);
  for (const Vec3& p : cut.interior.points) EXPECT_DOUBLE_EQ(p.z(), 2.0);
  EXPECT_EQ(cut.interior.points.size(), 20U);
}

TEST(CutOpen, BothPartsTogetherCloseWhatIsKept) {
  const auto mesh = tetrahedral_box(4, 4, 4);
  const CutPlane plane{{2, 2, 2}, {1, 2, 0.7}};
  const CutMesh cut = cut_open(mesh, plane);
  double kept = 0.0;
  for (const auto& t : mesh.tetrahedra) {
    Vec3 centroid = Vec3::Zero();
    for (const auto c : t) centroid += 0.25 * mesh.points[static_cast<std::size_t>(c)];
    if ((centroid - plane.point).dot(plane.normal) <= 0.0) kept += 1.0 / 6.0;
  }
  ASSERT_GT(kept, 10.0);
  EXPECT_NEAR(geometry::volume(geometry::merged(cut.boundary, cut.interior)), kept,
              1e-9);  // outward and closed
  EXPECT_GT(cut.interior.triangles.size(), 10U);
}

TEST(CutOpen, NothingCutShowsTheBoundaryAndAllCutShowsNothing) {
  const auto mesh = tetrahedral_box(2, 2, 2);
  const CutMesh whole = cut_open(mesh, {{0, 0, 99}, {0, 0, 1}});
  EXPECT_TRUE(whole.interior.triangles.empty());
  EXPECT_NEAR(geometry::area(whole.boundary), 24.0, 1e-12);
  EXPECT_NEAR(geometry::volume(whole.boundary), 8.0, 1e-12);
  const CutMesh none = cut_open(mesh, {{0, 0, -99}, {0, 0, 1}});
  EXPECT_TRUE(none.boundary.triangles.empty());
  EXPECT_TRUE(cut_actors(mesh, {{0, 0, -99}, {0, 0, 1}}).empty());
  EXPECT_EQ(cut_actors(mesh, {{1, 1, 1}, {0, 0, 1}}).size(), 2U);
}

TEST(CutOpen, RefusesBadInput) {
  auto mesh = tetrahedral_box(1, 1, 1);
  EXPECT_THROW(cut_open(geometry::VolumeMesh{}, {}), InvalidInput);
  EXPECT_THROW(cut_open(mesh, {{0, 0, 0}, {0, 0, 0}}), InvalidInput);
  mesh.tetrahedra[0][2] = 77;
  EXPECT_THROW(cut_open(mesh, {}), InvalidInput);
}

TEST(Clipped, ABallLosesItsCapExactly) {
  const auto part = clipped(geometry::welded(ball(5.0, 128), 1e-9), {{0, 0, 3.0}, {0, 0, 4}});
  // A spherical cap of height h has the area 2 pi r h.
  EXPECT_NEAR(geometry::area(part), 2 * std::numbers::pi * 5.0 * 8.0, 0.2);
  double highest = -100.0;
  for (const Vec3& p : part.points) highest = std::max(highest, p.z());
  EXPECT_NEAR(highest, 3.0, 1e-9);
  const auto loops = geometry::boundary_loops(part);
  ASSERT_EQ(loops.size(), 1U);
}

TEST(Clipped, KeepsAllOrNothingAwayFromTheSurface) {
  const auto mesh = ball(5.0, 16);
  const auto whole = clipped(mesh, {{0, 0, 9}, {0, 0, 1}});
  EXPECT_EQ(whole.triangles.size(), mesh.triangles.size());
  EXPECT_DOUBLE_EQ(geometry::area(whole), geometry::area(mesh));
  EXPECT_TRUE(clipped(mesh, {{0, 0, -9}, {0, 0, 1}}).triangles.empty());
  EXPECT_THROW(clipped(mesh, {{0, 0, 0}, {0, 0, 0}}), InvalidInput);
}

}  // namespace
}  // namespace ostia::figure
