#include "ostia/analysis/branch_sections.h"

#include "branched_shapes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::analysis {
namespace {

TEST(BranchSections, AnEllipticTubeHasItsAreaItsAxesAndItsShape) {
  constexpr int around = 64;
  geometry::AnalyticShape tube = geometry::straight_tube(30.0, 2.0);
  geometry::TriMesh wall = geometry::structured_surface(tube.tubes[0], around, 0.5);
  for (Vec3& p : wall.points) p.x() *= 1.5;
  const SurfaceSections sections = branch_sections(wall, one_line(tube.tubes[0].axis));
  ASSERT_EQ(sections.branches.size(), 15u);  // at 0, 2, ... 28 mm
  EXPECT_TRUE(sections.bifurcations.empty());
  EXPECT_TRUE(sections.warnings.empty());
  const double area = 3.0 * 2.0 * 0.5 * around * std::sin(2.0 * std::numbers::pi / around);  // of the polygon
  for (std::size_t i = 0; i < sections.branches.size(); ++i) {
    const BranchSection& one = sections.branches[i];
    EXPECT_EQ(one.spheres, static_cast<std::int32_t>(i));
    EXPECT_NEAR(one.point.z(), 2.0 * static_cast<double>(i), 1e-6);
    EXPECT_TRUE(one.closed);
    EXPECT_NEAR(one.area_mm2, area, 1e-6);
    EXPECT_NEAR(one.min_mm, 4.0, 0.01);
    EXPECT_NEAR(one.max_mm, 6.0, 0.01);
    EXPECT_NEAR(one.shape(), 2.0 / 3.0, 0.003);
    EXPECT_NEAR(one.normal.z(), 1.0, 1e-9);
  }
}

TEST(BranchSections, DiametersGoThroughTheAxisAlsoWhereItLiesBesideTheMiddle) {
  geometry::AnalyticShape tube = geometry::straight_tube(10.0, 2.0);
  geometry::TriMesh wall = geometry::structured_surface(tube.tubes[0], 360, 0.5);
  for (Vec3& p : wall.points) p.x() += 0.5;
  const SurfaceSections sections = branch_sections(wall, one_line(tube.tubes[0].axis));
  // Nearest and farthest lie on one diameter of the circle.
  EXPECT_NEAR(sections.branches[1].min_mm, 4.0, 1e-3);
  EXPECT_NEAR(sections.branches[1].max_mm, 4.0, 1e-3);
}

TEST(BranchSections, SectionsBesideABifurcationAreThoseOfItsBranches) {
  // Straight tubes of one calibre, 60 degrees apart.
  const geometry::VesselTree tree = straight_y(60.0, 0.0, 2.0);
  const geometry::TriMesh wall = geometry::surface_of(shape_of(tree), 0.2, true);
  const SurfaceSections sections = branch_sections(wall, geometry::branch_groups(tree));
  ASSERT_EQ(sections.bifurcations.size(), 3u);
  EXPECT_FALSE(sections.bifurcations[0].downstream);
  const double round = std::numbers::pi * 4.0;
  for (const BifurcationSection& one : sections.bifurcations) {
    EXPECT_TRUE(one.section.closed);
    EXPECT_NEAR(one.section.area_mm2, round, 0.01 * round);
    EXPECT_NEAR(one.section.min_mm, 4.0, 0.05);
    EXPECT_NEAR(one.section.max_mm, 4.0, 0.05);
  }
  for (const std::size_t i : {1u, 2u}) {
    EXPECT_TRUE(sections.bifurcations[i].downstream);
    EXPECT_EQ(sections.bifurcations[i].bifurcation, 1);
  }
  // Where the children begin, a plane across one runs on into the other: what is kept is the own wall.
  std::size_t closed = 0, open = 0;
  for (const BranchSection& one : sections.branches) {
    if (one.group == 0) continue;
    if (one.spheres == 0) {
      EXPECT_FALSE(one.closed);
      ++open;
    }
    if (one.spheres >= 1) {
      EXPECT_TRUE(one.closed);
      EXPECT_NEAR(one.area_mm2, round, 0.01 * round);
      ++closed;
    }
  }
  EXPECT_EQ(open, 2u);
  EXPECT_GE(closed, 12u);
}

TEST(BranchSections, AStepOfSeveralSpheresLeavesSectionsOut) {
  geometry::AnalyticShape tube = geometry::straight_tube(30.0, 2.0);
  const geometry::TriMesh wall = geometry::structured_surface(tube.tubes[0], 24, 0.5);
  const SurfaceSections sections = branch_sections(wall, one_line(tube.tubes[0].axis), {3, 1});
  ASSERT_EQ(sections.branches.size(), 5u);
  EXPECT_EQ(sections.branches[1].spheres, 3);
}

TEST(BranchSections, WhatCannotBeCutIsTold) {
  geometry::AnalyticShape tube = geometry::straight_tube(10.0, 1.0);
  geometry::TriMesh wall = geometry::structured_surface(tube.tubes[0], 24, 0.5);
  const geometry::BranchedLines lines = one_line(tube.tubes[0].axis);
  EXPECT_THROW(branch_sections({}, lines), InvalidInput);
  EXPECT_THROW(branch_sections(wall, {}), InvalidInput);
  EXPECT_THROW(branch_sections(wall, lines, {0, 1}), InvalidInput);
  for (Vec3& p : wall.points) p.z() += 1000.0;
  const SurfaceSections none = branch_sections(wall, lines);
  EXPECT_TRUE(none.branches.empty());
  ASSERT_EQ(none.warnings.size(), 1u);
}

}  // namespace
}  // namespace ostia::analysis
