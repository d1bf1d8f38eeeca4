// Flow extensions of real lumina, from what the pipeline makes of the files to the remeshed surface.
#include "shared_data.h"

#include "ostia/centerline/extract_centerlines.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/mesh_topology.h"
#include "ostia/meshing/caps.h"
#include "ostia/meshing/flow_extension.h"
#include "ostia/meshing/remesh.h"
#include "ostia/meshing/sizing.h"
#include "ostia/pipeline/repair.h"
#include "ostia/pipeline/source.h"

#include <gtest/gtest.h>

namespace ostia::meshing {
namespace {

void extend_and_judge(const std::filesystem::path& path) {
  const geometry::TriMesh lumen = pipeline::repaired(pipeline::load(path).surface).mesh;
  const geometry::VesselTree tree = centerline::extract_centerlines(lumen, std::nullopt, {}).tree;
  const ClippedSurface clipped = clip_ends(lumen, tree);
  const ExtendedEnds out = extend_ends(clipped, tree);
  ASSERT_EQ(out.extensions.size(), clipped.ends.size());
  EXPECT_TRUE(geometry::self_intersections(out.surface.mesh, 1).empty());
  for (const FlowExtension& e : out.extensions) {
    ::testing::Test::RecordProperty(e.end + " length, diameters",
                                    std::to_string(e.length_mm / e.diameter_mm));
    ::testing::Test::RecordProperty(e.end + " seam angle", std::to_string(e.seam_angle_deg));
    EXPECT_GE(e.seam_angle_deg, 25.0) << e.end;
    EXPECT_NEAR(e.end_area_mm2, e.section_area_mm2, 1e-3 * e.section_area_mm2) << e.end;
    EXPECT_GE(e.length_mm, 0.99 * e.diameter_mm) << e.end;
  }
  const geometry::FacedSurface capped = cap_ends(out.surface);
  geometry::SurfaceFaults faults = geometry::find_faults(capped.mesh, true);
  EXPECT_TRUE(faults.closed_manifold()) << faults.summary();
  const RemeshedSurface even = remesh(capped, target_edge_lengths(capped.mesh, TubeFunction(out.tree)));
  EXPECT_EQ(even.report.self_intersections, 0u);
  EXPECT_GE(even.report.min_angle_deg, 20.0);
}

TEST(FlowExtensionReal, Carotid) {
  OSTIA_REQUIRE_SHARED(path, "vessels/carotid-jackyko/lumen.stl");
  extend_and_judge(path);
}

TEST(FlowExtensionReal, VesselWithAneurysm) {
  OSTIA_REQUIRE_SHARED(path, "vessels/aneurysm-v4a/aneurysm_vascular_model.stl");
  extend_and_judge(path);
}

TEST(FlowExtensionReal, CoronaryPhantom) {
  OSTIA_REQUIRE_SHARED(path, "coronary/xra-phantom/phantom-tri3-coarse.stl");
  extend_and_judge(path);
}

}  // namespace
}  // namespace ostia::meshing
