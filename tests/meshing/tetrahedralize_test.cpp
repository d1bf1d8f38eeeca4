#include "ostia/meshing/tetrahedralize.h"

#include "test_surfaces.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/remesh.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

namespace ostia::meshing {
namespace {

geometry::FacedSurface remeshed_y() {
  const auto shape = geometry::y_junction(8.0, 8.0, 2.0, 1.5, 70.0);
  const auto input = capped(shape, 0.35, false);
  return remesh(input, target_edge_lengths(input.mesh, TubeFunction(tree_of(shape)))).surface;
}

TEST(Tetrahedralize, FillsAYAndKeepsItsBoundaryBitForBit) {
  const auto surface = remeshed_y();
  const auto result = tetrahedralize(surface);
  const geometry::VolumeMesh& mesh = result.mesh;
  EXPECT_EQ(mesh.boundary, surface.mesh.triangles);
  EXPECT_EQ(mesh.boundary_face_ids, surface.face_ids);
  EXPECT_EQ(mesh.faces.size(), 4u);
  EXPECT_TRUE(std::equal(surface.mesh.points.begin(), surface.mesh.points.end(), mesh.points.begin()));
  EXPECT_GT(mesh.points.size(), surface.mesh.points.size());
  const VolumeQuality quality = volume_quality(mesh);
  EXPECT_EQ(quality.inverted, 0u);
  EXPECT_EQ(quality.boundary_mismatches, 0u);
  EXPECT_TRUE(check(quality).ok()) << check(quality).summary();
  EXPECT_GE(quality.min_dihedral_deg, result.report.min_dihedral_before_mending_deg);
  EXPECT_NEAR(geometry::volume(mesh), geometry::volume(surface.mesh), 1e-9 * geometry::volume(mesh));
  EXPECT_NEAR(quality.mean_edge_mm, surface_quality(surface.mesh, false).mean_edge_mm,
              0.15 * quality.mean_edge_mm);
}

TEST(Tetrahedralize, ALargerSizeMakesFewerTetrahedra) {
  const auto surface = remeshed_y();
  TetrahedralizeOptions coarse;
  coarse.size_factor = 2.0;
  EXPECT_LT(tetrahedralize(surface, coarse).mesh.tetrahedra.size(),
            tetrahedralize(surface).mesh.tetrahedra.size());
}

/// A tube bent into itself: two capped tubes that cross, as one surface.
geometry::FacedSurface crossing_tubes() {
  auto surface = capped_tube();
  auto other = surface.mesh;
  for (auto& p : other.points) p = geometry::Vec3(p.z() - 6.0, p.y() + 0.3, p.x() + 6.1);
  for (auto& t : other.triangles) std::swap(t[0], t[1]);
  surface.mesh = geometry::merged(surface.mesh, other);
  surface.face_ids.resize(surface.mesh.triangles.size(), 1);
  return surface;
}

TEST(Tetrahedralize, NamesSelfIntersectionsBeforeAndInTheChild) {
  const auto surface = crossing_tubes();
  auto message = [&](bool check_input) -> std::string {
    TetrahedralizeOptions options;
    options.check_input = check_input;
    try {
      tetrahedralize(surface, options);
    } catch (const GeometryError& error) {
      return error.what();
    }
    return "";
  };
  EXPECT_NE(message(true).find("self-intersection"), std::string::npos) << message(true);
  EXPECT_NE(message(false).find("TetGen stopped"), std::string::npos) << message(false);
}

TEST(Tetrahedralize, ReportsAChildThatDiesOrRunsOut) {
  const auto surface = remeshed_y();
  TetrahedralizeOptions starved;
  starved.limits.memory_bytes = 12ULL << 20;
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_THROW(tetrahedralize(surface, starved), Error);
#endif
  ASSERT_EQ(setenv("OSTIA_WORKER", "/nowhere/ostia-worker", 1), 0);
  EXPECT_THROW(tetrahedralize(surface), IoError);
  unsetenv("OSTIA_WORKER");
}

TEST(Tetrahedralize, RefusesBadInputAndObeysCancel) {
  const auto surface = capped_tube();
  TetrahedralizeOptions bad;
  bad.size_factor = 0.0;
  EXPECT_THROW(tetrahedralize(surface, bad), InvalidInput);
  bad = {};
  bad.max_radius_edge_ratio = 0.5;
  EXPECT_THROW(tetrahedralize(surface, bad), InvalidInput);
  auto open = surface;
  open.mesh.triangles.pop_back();
  EXPECT_THROW(tetrahedralize(open), InvalidInput);  // ids no longer match
  open.face_ids.pop_back();
  EXPECT_THROW(tetrahedralize(open), GeometryError);
  auto inward = surface;
  for (auto& t : inward.mesh.triangles) std::swap(t[0], t[1]);
  EXPECT_THROW(tetrahedralize(inward), GeometryError);
  EXPECT_THROW(tetrahedralize({}), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(tetrahedralize(surface, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::meshing
