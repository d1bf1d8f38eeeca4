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
  EXPECT_NEAR(geometry::area(cut.interior.mesh), 12.0, 1e-12);
  EXPECT_NEAR(geometry::area(cut.boundary.mesh), 12.0 + 2 * (3.0 + 4.0) * 2.0, 1e-12);
  for (const Vec3& p : cut.interior.mesh.points) EXPECT_DOUBLE_EQ(p.z(), 2.0);
  EXPECT_EQ(cut.interior.mesh.points.size(), 20U);
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
  EXPECT_NEAR(geometry::volume(geometry::merged(cut.boundary.mesh, cut.interior.mesh)), kept,
              1e-9);  // outward and closed
  EXPECT_GT(cut.interior.mesh.triangles.size(), 10U);
}

TEST(CutOpen, NothingCutShowsTheBoundaryAndAllCutShowsNothing) {
  const auto mesh = tetrahedral_box(2, 2, 2);
  const CutMesh whole = cut_open(mesh, {{0, 0, 99}, {0, 0, 1}});
  EXPECT_TRUE(whole.interior.mesh.triangles.empty());
  EXPECT_NEAR(geometry::area(whole.boundary.mesh), 24.0, 1e-12);
  EXPECT_NEAR(geometry::volume(whole.boundary.mesh), 8.0, 1e-12);
  const CutMesh none = cut_open(mesh, {{0, 0, -99}, {0, 0, 1}});
  EXPECT_TRUE(none.boundary.mesh.triangles.empty());
  EXPECT_TRUE(cut_actors(mesh, {{0, 0, -99}, {0, 0, 1}}).empty());
  EXPECT_EQ(cut_actors(mesh, {{1, 1, 1}, {0, 0, 1}}).size(), 2U);
}

/// A box of nx x ny x nz unit cubes from the origin, two prisms each, upright.
geometry::MixedMesh prismatic_box(int nx, int ny, int nz) {
  geometry::MixedMesh mesh;
  const auto id = [&](int i, int j, int k) { return i + (nx + 1) * (j + (ny + 1) * k); };
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) mesh.points.emplace_back(i, j, k);
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int a = id(i, j, k), b = id(i + 1, j, k), c = id(i + 1, j + 1, k), d = id(i, j + 1, k);
        const int up = id(0, 0, 1);
        mesh.prisms.push_back({a, b, c, a + up, b + up, c + up});
        mesh.prisms.push_back({a, c, d, a + up, c + up, d + up});
      }
  return mesh;
}

TEST(CutOpen, PrismsAreLaidOpenWithTheirQuadrilaterals) {
  const auto mesh = prismatic_box(3, 4, 5);
  const CutMesh cut = cut_open(mesh, {{1.0, 0, 0}, {1, 0, 0}});  // between the first cubes and the second
  EXPECT_TRUE(cut.interior.mesh.triangles.empty());
  EXPECT_NEAR(geometry::area(cut.layers.mesh), 20.0, 1e-12);
  EXPECT_EQ(cut.layers.half_of_quad, std::vector<bool>(40, true));
  EXPECT_NEAR(geometry::volume(geometry::merged(cut.boundary.mesh, cut.layers.mesh)), 20.0, 1e-9);
  // The edge that is not drawn, from the third corner to the first, is the diagonal.
  for (const auto& t : cut.layers.mesh.triangles) {
    const auto at = [&](std::size_t i) { return cut.layers.mesh.points[static_cast<std::size_t>(t[i])]; };
    EXPECT_NEAR((at(0) - at(2)).norm(), std::sqrt(2.0), 1e-12);
  }
  std::size_t halves = 0;
  for (const bool half : cut.boundary.half_of_quad) halves += half;
  EXPECT_EQ(cut.boundary.half_of_quad.size(), cut.boundary.mesh.triangles.size());
  EXPECT_EQ(cut.boundary.mesh.triangles.size() - halves, 2U * 2 * 4) << "floor and ceiling are triangles";
  const CutMesh across = cut_open(mesh, {{0, 0, 2.0}, {0, 0, 1}});
  EXPECT_EQ(across.layers.half_of_quad, std::vector<bool>(24, false));
}

TEST(CutOpen, APictureOfPrismsHasNoDiagonals) {
  const auto mesh = prismatic_box(1, 1, 1);
  Scene scene{cut_actors(mesh, {{0, 0, 9}, {0, 0, 1}}), {}, {}};
  RenderOptions look;
  look.width_px = look.height_px = 64;
  look.occlusion_rays = 0;
  const auto dark = [&] {  // pixels that an edge covers
    const Raster raster = render(scene, cameras::anterior(), look);
    std::size_t count = 0;
    for (int y = 8; y < 56; ++y)
      for (int x = 8; x < 56; ++x) count += raster.pixel(x, y)[0] < 64;
    return count;
  };
  const std::size_t without = dark();
  scene.meshes[0].half_of_quad.assign(scene.meshes[0].mesh.triangles.size(), false);
  EXPECT_GT(dark(), without + 30);
  scene.meshes[0].half_of_quad.resize(1);
  EXPECT_THROW(dark(), InvalidInput);
}

TEST(CutOpen, RefusesBadInput) {
  auto mesh = tetrahedral_box(1, 1, 1);
  EXPECT_THROW(cut_open(geometry::MixedMesh{}, {}), InvalidInput);
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
