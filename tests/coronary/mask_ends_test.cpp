#include "mask_ends.h"

#include "ostia/geometry/polyline.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

namespace ostia::coronary {
namespace {

using geometry::TreeSegment;

std::vector<Vec3> line_between(const Vec3& from, const Vec3& to) {
  std::vector<Vec3> points;
  const int steps = std::max(1, static_cast<int>((to - from).norm() / 0.5));
  for (int i = 0; i <= steps; ++i) points.push_back(from + (static_cast<double>(i) / steps) * (to - from));
  return points;
}

TreeSegment straight_segment(std::int32_t id, std::int32_t from, std::int32_t to, const Vec3& a,
                             const Vec3& b, double radius_mm) {
  TreeSegment segment{id, from, to, {}};
  segment.axis.points = line_between(a, b);
  segment.axis.radius.assign(segment.axis.points.size(), radius_mm);
  geometry::complete(segment.axis);
  return segment;
}

/// A trunk of 2 mm radius from the origin along z, 60 mm, with a branch at `fork_mm` to `tip`.
MaskAxes trunk_with_branch(double fork_mm, const Vec3& tip, double branch_mm) {
  const Vec3 fork(0, 0, fork_mm), end(0, 0, 60);
  MaskAxes axes;
  axes.tree.nodes = {{1, Vec3::Zero()}, {2, fork}, {3, end}, {4, tip}};
  axes.tree.segments = {straight_segment(1, 1, 2, Vec3::Zero(), fork, 2.0),
                        straight_segment(2, 2, 3, fork, end, 2.0),
                        straight_segment(3, 2, 4, fork, tip, branch_mm)};
  axes.tree.vessels = {{1, "V1", {1, 2}}, {2, "V2", {1, 3}}};
  axes.ostia = {1};
  return axes;
}

TEST(MaskEnds, CleanEndsStayAsTheyAre) {
  MaskAxes axes = trunk_with_branch(30, {20, 0, 40}, 1.0);
  EXPECT_TRUE(settle_ends(axes).empty());
  EXPECT_EQ(axes.tree.vessels.size(), 2U);
  EXPECT_EQ(geometry::find_fault(axes.tree).value_or("none"), "none");
}

TEST(MaskEnds, AStubWithinReachOfItsParentIsLeftOutAndTheParentIsWhole) {
  MaskAxes axes = trunk_with_branch(30, {2.5, 0, 30}, 1.0);
  const std::vector<MaskEndChange> changes = settle_ends(axes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MaskEndChange::Kind::left_out);
  EXPECT_LT((changes[0].place - Vec3(2.5, 0, 30)).norm(), 1e-9);
  EXPECT_NEAR(changes[0].length_mm, 2.5, 1e-9);
  EXPECT_EQ(changes[0].vessel, 0);
  ASSERT_EQ(axes.tree.vessels.size(), 1U);
  EXPECT_EQ(axes.tree.segments.size(), 1U);
  EXPECT_EQ(axes.tree.nodes.size(), 2U);
  EXPECT_NEAR(geometry::vessel_axis(axes.tree, axes.tree.vessels[0]).abscissa.back(), 60.0, 1e-6);
  EXPECT_EQ(geometry::find_fault(axes.tree).value_or("none"), "none");
}

TEST(MaskEnds, ATrunkThatEndsRightBehindItsForkGoesOnAsTheBranch) {
  MaskAxes axes = trunk_with_branch(58.5, {30, 0, 70}, 1.2);
  const std::vector<MaskEndChange> changes = settle_ends(axes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MaskEndChange::Kind::left_out);
  ASSERT_EQ(axes.tree.vessels.size(), 1U);
  EXPECT_LT((geometry::vessel_axis(axes.tree, axes.tree.vessels[0]).points.back() - Vec3(30, 0, 70)).norm(),
            1e-9);
  EXPECT_EQ(geometry::find_fault(axes.tree).value_or("none"), "none");
}

/// Both planes see one vessel alone, but the wall between them leans over from the one to the other.
TEST(MaskEnds, ATipThatForksHasOneEnd) {
  const double half_angle = 0.575, radius = 0.6;
  const Vec3 fork(0, 0, 30);
  const auto tip = [&](double side, double length_mm) {
    return Vec3(fork + length_mm * Vec3(side * std::sin(half_angle), 0.0, std::cos(half_angle)));
  };
  const Vec3 shorter = tip(1.0, 1.6), longer = tip(-1.0, 2.0);
  MaskAxes axes;
  axes.tree.nodes = {{1, Vec3::Zero()}, {2, fork}, {3, longer}, {4, shorter}};
  axes.tree.segments = {straight_segment(1, 1, 2, Vec3::Zero(), fork, radius),
                        straight_segment(2, 2, 3, fork, longer, radius),
                        straight_segment(3, 2, 4, fork, shorter, radius)};
  axes.tree.vessels = {{1, "V1", {1, 2}}, {2, "V2", {1, 3}}};
  axes.ostia = {1};
  const std::vector<MaskEndChange> changes = settle_ends(axes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MaskEndChange::Kind::left_out);
  EXPECT_LT((changes[0].place - shorter).norm(), 1e-9);
  ASSERT_EQ(axes.tree.vessels.size(), 1U);
  EXPECT_LT((geometry::vessel_axis(axes.tree, axes.tree.vessels[0]).points.back() - longer).norm(), 1e-9);
}

TEST(MaskEnds, AnEndThatTouchesAnotherVesselIsShortenedToACleanPlace) {
  MaskAxes axes = trunk_with_branch(15, {30, 0, 40}, 1.0);
  // Another tree whose side lies 1.2 mm beyond the branch's end.
  const Vec3 beyond = Vec3(30, 0, 40) + 1.2 * (Vec3(30, 0, 40) - Vec3(0, 0, 15)).normalized();
  axes.tree.nodes.push_back({5, beyond - Vec3(0, 30, 0)});
  axes.tree.nodes.push_back({6, beyond + Vec3(0, 30, 0)});
  axes.tree.segments.push_back(
      straight_segment(4, 5, 6, beyond - Vec3(0, 30, 0), beyond + Vec3(0, 30, 0), 1.0));
  axes.tree.vessels.push_back({3, "V3", {4}});
  const std::vector<MaskEndChange> changes = settle_ends(axes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MaskEndChange::Kind::shortened);
  EXPECT_EQ(changes[0].vessel, 2);
  EXPECT_GT(changes[0].length_mm, 0.5);
  EXPECT_LT(changes[0].length_mm, 2.5);
  const Vec3 end = geometry::vessel_axis(axes.tree, axes.tree.vessels[1]).points.back();
  EXPECT_NEAR((end - Vec3(30, 0, 40)).norm(), changes[0].length_mm, 1e-6);
  EXPECT_EQ(geometry::find_fault(axes.tree).value_or("none"), "none");
}

/// At its very end an axis' radius falls; the wall's does not.
TEST(MaskEnds, EndsThatPointAtEachOtherKeepRoomForTheirDomes) {
  const auto with_gap = [](double gap_mm) {
    MaskAxes axes;
    const double far = 60.0 + gap_mm + 60.0, near = 60.0 + gap_mm;
    axes.tree.nodes = {{1, Vec3::Zero()}, {2, Vec3(0, 0, 60)}, {3, Vec3(0, 0, far)}, {4, Vec3(0, 0, near)}};
    axes.tree.segments = {straight_segment(1, 1, 2, Vec3::Zero(), Vec3(0, 0, 60), 2.0),
                          straight_segment(2, 3, 4, Vec3(0, 0, far), Vec3(0, 0, near), 2.0)};
    for (TreeSegment& segment : axes.tree.segments)
      for (std::size_t k = 1; k <= 3; ++k)
        segment.axis.radius[segment.axis.radius.size() - k] = 1.0 + 0.25 * static_cast<double>(k - 1);
    axes.tree.vessels = {{1, "V1", {1}}, {2, "V2", {2}}};
    axes.ostia = {1, 3};
    return axes;
  };
  MaskAxes apart = with_gap(6.0);
  EXPECT_TRUE(settle_ends(apart).empty());
  MaskAxes touching = with_gap(3.4);
  const std::vector<MaskEndChange> changes = settle_ends(touching);
  ASSERT_FALSE(changes.empty());
  for (const MaskEndChange& change : changes) EXPECT_EQ(change.kind, MaskEndChange::Kind::shortened);
  const Vec3 a = geometry::vessel_axis(touching.tree, touching.tree.vessels[0]).points.back(),
             b = geometry::vessel_axis(touching.tree, touching.tree.vessels[1]).points.back();
  EXPECT_GT((a - b).norm(), 0.6 * 2.0 + 1.1 * 2.0 + 0.3 - 1e-9);  // a cut end's dome, the other's, and room
  EXPECT_LT((a - b).norm(), 6.0);
}

TEST(MaskEnds, AnOstiumRightAtAForkBeginsEarlier) {
  MaskAxes axes = trunk_with_branch(1.0, {25, 0, 12}, 1.6);
  const std::vector<MaskEndChange> changes = settle_ends(axes);
  ASSERT_EQ(changes.size(), 1U);
  EXPECT_EQ(changes[0].kind, MaskEndChange::Kind::led_on);
  EXPECT_GT(changes[0].length_mm, 0.5);
  EXPECT_LT(changes[0].length_mm, 5.0);
  EXPECT_LT((geometry::node(axes.tree, axes.ostia[0]).position - Vec3(0, 0, -changes[0].length_mm)).norm(),
            1e-6);
  EXPECT_EQ(geometry::find_fault(axes.tree).value_or("none"), "none");
}

}  // namespace
}  // namespace ostia::coronary
