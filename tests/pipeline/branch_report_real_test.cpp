// A carotid bifurcation with a tight stenosis, measured on its own lines.

#include "shared_data.h"

#include "ostia/io/centerline_file.h"
#include "ostia/io/surface_file.h"
#include "ostia/pipeline/branch_report.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::pipeline {
namespace {

TEST(BranchReportReal, ACarotidHasOneBifurcationAndItsStenosisIsTheLeastSection) {
  OSTIA_REQUIRE_SHARED(folder, "vessels/carotid-jackyko");
  BranchWall wall;
  wall.mesh = io::read_surface(folder / "lumen.stl").surface.mesh;
  const geometry::VesselTree tree = io::read_centerlines(folder / "centerline.vtp");
  BranchReportOptions options;
  options.bifurcations = options.sections = true;
  options.patches = analysis::PatchOptions{2.0, 12};
  const BranchReport report = measured_branches(geometry::branch_groups(tree), wall, options);
  ASSERT_EQ(report.bifurcations->systems.size(), 1u);
  EXPECT_EQ(report.bifurcations->vectors.size(), 3u);
  // Carotids part by 40 to 90 degrees.
  const double angle = analysis::angle_between_branches(*report.bifurcations, 1) * 57.29578;
  EXPECT_GT(angle, 40.0);
  EXPECT_LT(angle, 90.0);
  double least = 1e9;
  std::size_t closed = 0;
  for (const analysis::BranchSection& one : report.sections->branches) {
    if (!one.closed) continue;
    ++closed;
    least = std::min(least, one.area_mm2);
    EXPECT_GE(one.max_mm, one.min_mm);
    EXPECT_LT(one.area_mm2, 45.0);  // the common carotid is 7 mm wide
  }
  EXPECT_GT(closed, 40u);
  EXPECT_LT(least, 1.0);
  double patches = 0.0;
  for (const analysis::WallPatch& patch : report.patched->patches) patches += patch.area_mm2;
  EXPECT_GT(patches, 1000.0);
}

}  // namespace
}  // namespace ostia::pipeline
