#include "io_test_support.h"

#include "ostia/geometry/mesh_topology.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"

namespace ostia::io {
namespace {

TEST(SurfaceReal, Carotid) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  const auto mesh = read_surface(path).surface.mesh;
  EXPECT_EQ(mesh.triangles.size(), 9071u);
  EXPECT_EQ(geometry::boundary_loops(mesh).size(), 3u);
}

TEST(SurfaceReal, CappedCarotidIsNotManifold) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/leftlumen_capped.stl");
  EXPECT_EQ(geometry::find_faults(read_surface(path).surface.mesh, false).non_manifold_edges, 6u);
}

TEST(SurfaceReal, CarotidCenterlines) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/centerline.vtp");
  const geometry::VesselTree tree = read_centerlines(path);
  EXPECT_GE(tree.vessels.size(), 2u);
  for (const auto& segment : tree.segments) EXPECT_GT(segment.axis.abscissa.back(), 1.0);
}

TEST(SurfaceReal, CoronaryPhantom) {
  OSTIA_REQUIRE_SHARED(surface, "coronary/xra-phantom/phantom-tri3-coarse.stl");
  EXPECT_EQ(read_surface(surface).surface.mesh.triangles.size(), 12960u);
}

TEST(SurfaceReal, Aneurysm) {
  OSTIA_REQUIRE_SHARED(path, "vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
  EXPECT_EQ(read_surface(path).surface.mesh.triangles.size(), 44443u);
}

}  // namespace
}  // namespace ostia::io
