#include "ostia/analysis/bifurcations.h"

#include "branched_shapes.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::analysis {
namespace {

using geometry::BranchedLine;
using geometry::BranchedLines;

TEST(Bifurcations, AYOfStraightTubesHasItsAnglesAndPlane) {
  for (const double between : {30.0, 60.0, 90.0, 120.0}) {
    const BifurcationMeasures m =
        measure_bifurcations(geometry::branch_groups(straight_y(between, 0.0, 2.0)));
    ASSERT_EQ(m.systems.size(), 1u);
    const BifurcationSystem& system = m.systems[0];
    EXPECT_EQ(system.group, 1);
    EXPECT_NEAR(std::abs(system.normal.y()), 1.0, 1e-9);
    EXPECT_NEAR(system.up_normal.z(), 1.0, 1e-9);
    EXPECT_NEAR(system.origin.x(), 0.0, 1e-9);
    ASSERT_EQ(m.vectors.size(), 3u);
    EXPECT_FALSE(m.vectors[0].downstream);
    EXPECT_EQ(m.vectors[0].group, 0);
    EXPECT_NEAR(m.vectors[0].in_plane_rad, 0.0, 1e-9);
    const double first = m.vectors[1].in_plane_rad, second = m.vectors[2].in_plane_rad;
    EXPECT_NEAR(std::abs(first), 0.5 * between * degree, 1e-9);
    EXPECT_NEAR(second, -first, 1e-9);
    for (const BifurcationVector& one : m.vectors) EXPECT_NEAR(one.out_of_plane_rad, 0.0, 1e-9);
    EXPECT_NEAR(m.vectors[1].vector.norm(), 2.0, 1e-9);  // one inscribed sphere
    EXPECT_NEAR(angle_between_branches(m, 1), between * degree, 1e-9);
  }
}

TEST(Bifurcations, AParentThatComesFromBehindThePlaneIsOutOfIt) {
  // At 120 degrees the bifurcation begins at the fork, so that the parent's last sphere lies on its axis.
  const BifurcationMeasures m = measure_bifurcations(geometry::branch_groups(straight_y(120.0, 20.0, 2.0)));
  ASSERT_EQ(m.vectors.size(), 3u);
  const Vec3 along(0, std::sin(20.0 * degree), std::cos(20.0 * degree));
  EXPECT_NEAR((m.vectors[0].vector - 2.0 * along).norm(), 0.0, 1e-6);
  EXPECT_NEAR(m.vectors[0].out_of_plane_rad, std::copysign(20.0 * degree, m.systems[0].normal.y()), 1e-6);
  EXPECT_NEAR(m.vectors[0].in_plane_rad, 0.0, 1e-6);
  EXPECT_NEAR(m.vectors[1].out_of_plane_rad, 0.0, 1e-9);
  EXPECT_NEAR((m.vectors[0].in_plane + m.vectors[0].out_of_plane - m.vectors[0].vector).norm(), 0.0, 1e-12);
}

BranchedLine line_with_tract(std::int32_t vessel, const Vec3& from, double radius_from, const Vec3& to,
                             double radius_to) {
  BranchedLine line;
  line.vessel = vessel;
  line.axis.points = {from, to};
  line.axis.radius = {radius_from, radius_to};
  geometry::complete(line.axis);
  line.tracts = {{1, true, {{0, 0.0}, {1, 0.0}}}};
  return line;
}

TEST(Bifurcations, TheSystemOfVmtksTestAortaIsTheOneThatItsTestsExpect) {
  // The ends of both tracts of its aorta-centerline-branches.vtp, and
  // test_vmtkbifurcationreferencesystems.py.
  BranchedLines lines;
  lines.groups = 2;
  lines.lines = {line_with_tract(0, {222.550674, 140.652985, 23.771286}, 6.46021748,
                                 {225.063736, 134.705444, 23.557091}, 5.28353593),
                 line_with_tract(1, {220.890381, 140.920502, 23.99687}, 6.65795358,
                                 {218.531403, 134.761719, 24.909559}, 5.58529132)};
  const BifurcationMeasures m = measure_bifurcations(lines);
  ASSERT_EQ(m.systems.size(), 1u);
  EXPECT_NEAR((m.systems[0].origin - Vec3(221.663269, 138.325073, 24.043575)).norm(), 0.0, 2e-5);
  EXPECT_NEAR((m.systems[0].normal - Vec3(-0.16795282, -0.05915027, -0.98401885)).norm(), 0.0, 1e-6);
  EXPECT_NEAR((m.systems[0].up_normal - Vec3(-0.00365111, -0.99815405, 0.06062313)).norm(), 0.0, 1e-6);
}

TEST(Bifurcations, BranchesBendAsTheirHelixDoes) {
  const geometry::AnalyticShape helix = geometry::helix_tube(6.0, 10.0, 2.0, 0.25, 0.05);
  const BifurcationMeasures m = measure_bifurcations(one_line(helix.tubes[0].axis));
  ASSERT_EQ(m.branches.size(), 1u);
  EXPECT_TRUE(m.systems.empty());
  const double b = 10.0 / (2.0 * std::numbers::pi), c2 = 36.0 + b * b,
               length = 4.0 * std::numbers::pi * std::sqrt(c2);
  EXPECT_NEAR(m.branches[0].curvature, 6.0 / c2, 2e-4);
  EXPECT_NEAR(std::abs(m.branches[0].torsion), b / c2, 1e-3);
  EXPECT_NEAR(m.branches[0].length_mm, length, 1e-2);
  EXPECT_NEAR(m.branches[0].tortuosity, length / 20.0 - 1.0, 1e-3);
  EXPECT_NEAR(m.branches[0].mean_radius_mm, 0.25, 1e-9);
}

TEST(Bifurcations, TractsInOneLineHaveNoPlaneAndAreTold) {
  BranchedLines lines;
  lines.groups = 2;
  lines.lines = {line_with_tract(0, {0, 0, 0}, 1.0, {0, 0, 1}, 1.0),
                 line_with_tract(1, {0, 0, 0}, 1.0, {0, 0, 2}, 1.0)};
  const BifurcationMeasures m = measure_bifurcations(lines);
  EXPECT_TRUE(m.systems.empty());
  ASSERT_EQ(m.warnings.size(), 1u);
  EXPECT_THROW(measure_bifurcations({}), InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
