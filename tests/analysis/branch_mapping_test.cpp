#include "ostia/analysis/branch_mapping.h"

#include "branched_shapes.h"

#include "ostia/core/error.h"
#include "ostia/geometry/mesh_topology.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace ostia::analysis {
namespace {

constexpr int sides = 48;

/// A tube along +z, 20 mm long, of radius 2.
struct Tube {
  geometry::AnalyticShape shape = geometry::straight_tube(20.0, 2.0);
  geometry::TriMesh wall = geometry::structured_surface(shape.tubes[0], sides, 0.5);
  geometry::BranchedLines lines = one_line(shape.tubes[0].axis);
};

TEST(BranchMapping, ATubesCoordinatesAreItsHeightAndItsAngle) {
  const Tube tube;
  const MappedWall mapped = map_branches(tube.wall, tube.lines);
  ASSERT_EQ(mapped.branches.size(), 1u);
  const MappedBranch& branch = mapped.branches[0];
  EXPECT_TRUE(mapped.warnings.empty());
  ASSERT_EQ(branch.mesh.points.size(), tube.wall.points.size());
  const geometry::Frame& frame = tube.lines.lines[0].axis.frames.front();
  for (std::size_t i = 0; i < branch.mesh.points.size(); ++i) {
    const Vec3& p = branch.mesh.points[i];
    EXPECT_NEAR(branch.abscissa_mm[i], p.z(), 1e-6);
    EXPECT_NEAR(std::remainder(branch.angle_rad[i] - geometry::angle_of(frame, Vec3(p.x(), p.y(), 0)),
                               2.0 * std::numbers::pi),
                0.0, 1e-6);
    EXPECT_NEAR(branch.distance_mm[i], 2.0, 1e-6);
    EXPECT_NEAR(branch.harmonic[i], p.z() / 20.0, 1e-3);
    EXPECT_NEAR(branch.stretched_mm[i], p.z(), 0.02);
  }
}

TEST(BranchMapping, PatchesOfATubeAreItsUnrolledRectangles) {
  const Tube tube;
  const MappedWall mapped = map_branches(tube.wall, tube.lines);
  std::vector<double> height, one;
  for (const Vec3& p : mapped.branches[0].mesh.points) {
    height.push_back(p.z());
    one.push_back(7.0);
  }
  const PatchedWall patched = patch_branches(mapped, {{height, one}}, {5.0, 4});
  ASSERT_EQ(patched.patches.size(), 16u);
  double area = 0.0;
  for (const WallPatch& patch : patched.patches) {
    EXPECT_NEAR(patch.area_mm2, geometry::area(tube.wall) / 16.0, 0.02);
    EXPECT_NEAR(patch.means[0], 5.0 * patch.along + 2.5, 0.02);
    EXPECT_NEAR(patch.means[1], 7.0, 1e-9);
    EXPECT_GE(patch.around, -2);
    EXPECT_LT(patch.around, 2);
    area += patch.area_mm2;
  }
  EXPECT_NEAR(area, geometry::area(tube.wall), 1e-9 * area);
  double triangles = 0.0;
  for (const PatchTriangle& t : patched.triangles)
    triangles += 0.5 * (t.corners[1] - t.corners[0]).cross(t.corners[2] - t.corners[0]).norm();
  EXPECT_NEAR(triangles, area, 1e-9 * area);
}

TEST(BranchMapping, ThePartsOfAYAreTubesThatMakeUpTheWall) {
  const geometry::AnalyticShape y = geometry::y_junction(20.0, 20.0, 2.0, 1.5, 70.0);
  const geometry::TriMesh wall = geometry::surface_of(y, 0.3, true);
  const MappedWall mapped = map_branches(wall, geometry::branch_groups(tree_of_tubes(y)));
  ASSERT_EQ(mapped.branches.size(), 3u);
  EXPECT_TRUE(mapped.warnings.empty());
  double area = 0.0;
  for (const MappedBranch& branch : mapped.branches) {
    area += geometry::area(branch.mesh);
    EXPECT_EQ(geometry::boundary_loops(branch.mesh).size(), 2u);
    EXPECT_EQ(branch.harmonic.size(), branch.mesh.points.size());
    // Values travel with the points.
    std::vector<double> height;
    for (const Vec3& p : wall.points) height.push_back(p.z());
    const std::vector<double> here = mapped_values(branch, height, 1);
    for (std::size_t i = 0; i < here.size(); ++i) EXPECT_NEAR(here[i], branch.mesh.points[i].z(), 1e-9);
    // From end to end it only rises with the abscissa, but for the borders' skew.
    const auto [least, most] = std::minmax_element(branch.stretched_mm.begin(), branch.stretched_mm.end());
    EXPECT_LT(*least, *most);
  }
  EXPECT_NEAR(area, geometry::area(wall), 1e-9 * area);
  EXPECT_EQ(mapped.branches[0].group, 0);
  EXPECT_LT(geometry::bounds(mapped.branches[0].mesh.points).max().z(), 6.0);
}

TEST(BranchMapping, AClosedTubeHasNoHarmonicMapAndIsTold) {
  Tube tube;
  tube.wall = geometry::fill_holes(tube.wall).mesh;
  const MappedWall mapped = map_branches(tube.wall, tube.lines);
  EXPECT_TRUE(mapped.branches[0].harmonic.empty());
  EXPECT_EQ(mapped.branches[0].stretched_mm, mapped.branches[0].abscissa_mm);
  ASSERT_EQ(mapped.warnings.size(), 1u);
}

TEST(BranchMapping, WhatCannotBeMappedOrPatchedIsTold) {
  const Tube tube;
  EXPECT_THROW(map_branches({}, tube.lines), InvalidInput);
  EXPECT_THROW(map_branches(tube.wall, {}), InvalidInput);
  const MappedWall mapped = map_branches(tube.wall, tube.lines);
  EXPECT_THROW(patch_branches(mapped, {{}}, {0.0, 4}), InvalidInput);
  EXPECT_THROW(patch_branches(mapped, {{}}, {1.0, 0}), InvalidInput);
  EXPECT_THROW(patch_branches(mapped, {}, {1.0, 4}), InvalidInput);
  EXPECT_THROW(patch_branches(mapped, {{{1.0, 2.0}}}, {1.0, 4}), InvalidInput);
  EXPECT_THROW(patch_branches(mapped, {{}}, {1e-5, 4}), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
