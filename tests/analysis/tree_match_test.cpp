// Trees of two scans, laid on each other by motions that are known beforehand.

#include "two_scans.h"

#include "ostia/core/error.h"
#include "ostia/geometry/polyline.h"

#include <gmock/gmock.h>

namespace ostia::analysis {
namespace {

using ::testing::HasSubstr;
using testing::heart_tree;
using testing::HeartOptions;
using ::testing::IsEmpty;
using testing::known_motion;
using testing::moved_heart;

std::optional<double> carried_place(const TreeMatch& match, std::int32_t vessel, double s_mm) {
  const VesselMatch* one = match.of_before(vessel);
  return one ? one->to_after(s_mm) : std::nullopt;
}

const geometry::Vessel& geometry_vessel(const geometry::VesselTree& tree, std::int32_t id) {
  return *std::ranges::find(tree.vessels, id, &geometry::Vessel::id);
}

TEST(TreeMatch, AKnownMotionIsFound) {
  const auto before = heart_tree(), after = heart_tree(moved_heart());
  const TreeFit fit = fit_trees(before, after);
  EXPECT_EQ(fit.vessels, 4u);
  EXPECT_LT(fit.axes_mm, 1e-3);
  EXPECT_GT(fit.mirrored_mm, 3.0);
  ASSERT_EQ(fit.landmarks.size(), 4u);
  EXPECT_EQ(fit.landmarks[0].name, "RCA, ostium");
  EXPECT_EQ(fit.landmarks[3].name, "D1 leaves LAD");
  for (const double residual : fit.landmark_residuals_mm) EXPECT_LT(residual, 1e-2);
  for (const geometry::TreeNode& node : before.nodes)
    EXPECT_LT((fit.motion(node.position) - known_motion()(node.position)).norm(), 1e-2);
}

TEST(TreeMatch, AxesThatBeginElsewhereAreLaidOnEachOther) {
  // The later axes begin 6 mm further on: equal lengths are other places.
  auto after = heart_tree(moved_heart());
  for (geometry::TreeSegment& segment : after.segments) {
    if (segment.id != 11 && segment.id != 12) continue;
    auto& axis = segment.axis;
    axis.points.erase(axis.points.begin(), axis.points.begin() + 12);
    axis.radius.resize(axis.points.size());
    geometry::complete(axis);
    after.nodes[segment.id == 11 ? 0 : 2].position = axis.points.front();
  }
  const auto before = heart_tree();
  const TreeFit fit = fit_trees(before, after);
  EXPECT_LT(fit.axes_mm, 0.02);
  const TreeMatch match = match_trees(before, after, fit.motion);
  const double begins = geometry::length(heart_tree().segments[0].axis.points) -
                        geometry::length(after.segments[0].axis.points);
  EXPECT_NEAR(carried_place(match, 1, 40.0).value_or(0.0), 40.0 - begins, 0.1);
  EXPECT_FALSE(carried_place(match, 1, 2.0)) << "the later tree does not reach there";
}

TEST(TreeMatch, VesselsAreMatchedWithTheirPlaces) {
  const auto before = heart_tree(), after = heart_tree(moved_heart());
  const TreeMatch match = match_trees(before, after, known_motion());
  ASSERT_EQ(match.vessels.size(), 4u);
  EXPECT_THAT(match.before_alone, IsEmpty());
  EXPECT_THAT(match.after_alone, IsEmpty());
  EXPECT_NEAR(match.shared_share, 1.0, 0.02);
  for (const VesselMatch& one : match.vessels) {
    EXPECT_EQ(one.before, one.after);
    EXPECT_TRUE(one.by_name);
    EXPECT_LT(one.distance_mm, 0.01);
    for (double s = 5.0; s < 35.0; s += 2.7) {
      ASSERT_TRUE(one.to_after(s));
      EXPECT_NEAR(*one.to_after(s), s, 0.05);
      EXPECT_NEAR(one.to_before(*one.to_after(s)).value_or(0.0), s, 1e-6);
    }
  }
}

TEST(TreeMatch, GeometryIsBelievedBeforeAName) {
  HeartOptions other = moved_heart();
  other.diagonal = "D2";  // the same branch, counted otherwise
  other.circumflex_first = true;
  const TreeMatch match = match_trees(heart_tree(), heart_tree(other), known_motion());
  ASSERT_EQ(match.vessels.size(), 4u);
  for (const VesselMatch& one : match.vessels) EXPECT_EQ(one.before, one.after);
  EXPECT_FALSE(match.of_before(4)->by_name);
  EXPECT_EQ(match.of_after(4)->before, 4);
}

TEST(TreeMatch, AHeartThatIsBentOtherwiseIsMatchedByNames) {
  // 4 mm of motion that no rigid map has: names still pair the vessels, places by axes laid on each other.
  HeartOptions bent;
  bent.moved = [](const Vec3& p) -> Vec3 { return p + Vec3(0.0, 4.0 * std::sin(p.z() / 20.0), 0.0); };
  const auto before = heart_tree(), after = heart_tree(bent);
  const TreeFit fit = fit_trees(before, after);
  EXPECT_GT(fit.axes_mm, 0.3);
  EXPECT_THAT(why_another_patient(fit, match_trees(before, after, fit.motion)), IsEmpty());
  const TreeMatch match = match_trees(before, after, fit.motion);
  ASSERT_EQ(match.vessels.size(), 4u);
  for (const VesselMatch& one : match.vessels) {
    EXPECT_EQ(one.before, one.after);
    const geometry::AxisCurve was(geometry::vessel_axis(before, geometry_vessel(before, one.before)));
    const geometry::AxisCurve is(geometry::vessel_axis(after, geometry_vessel(after, one.after)));
    const double half = 0.5 * was.length();
    EXPECT_NEAR(one.to_after(half).value_or(0.0), is.nearest_foot(bent.moved(was.point(half))).s_mm, 3.0)
        << one.before;
  }
}

TEST(TreeMatch, ABranchOfOneScanStaysAlone) {
  auto after = heart_tree(moved_heart());
  after.vessels.pop_back();
  after.segments.pop_back();
  after.nodes.pop_back();
  const TreeMatch match = match_trees(heart_tree(), after, known_motion());
  EXPECT_THAT(match.before_alone, ::testing::ElementsAre(4));
  EXPECT_THAT(match.after_alone, IsEmpty());
  EXPECT_EQ(match.of_before(4), nullptr);
}

TEST(TreeMatch, AnotherPatientAndAMirroredOneAreTold) {
  TreeMatch whole;
  whole.shared_share = 1.0;
  TreeFit fit;
  EXPECT_THAT(why_another_patient(fit, whole), IsEmpty());
  fit.axes_mm = 9.0, fit.mirrored_mm = 8.0;
  EXPECT_THAT(why_another_patient(fit, whole),
              HasSubstr("are 9.0 mm apart when the trees lie on each other"));
  fit.mirrored_mm = 1.0;
  EXPECT_THAT(why_another_patient(fit, whole), HasSubstr("one of the trees is mirrored"));
  fit.axes_mm = 1.0;
  fit.landmark_residuals_mm = {1.0, 12.0, 14.0};
  EXPECT_THAT(why_another_patient(fit, whole), HasSubstr("half of the ostia and forks"));
  EXPECT_THAT(why_another_patient({}, {}), HasSubstr("0 % of the shorter tree"));
  HeartOptions mirrored;
  mirrored.moved = [](const Vec3& p) -> Vec3 { return {-p.x(), p.y(), p.z()}; };
  EXPECT_LT(fit_trees(heart_tree(), heart_tree(mirrored)).mirrored_mm, 1e-3);
}

TEST(TreeMatch, WhatSaysNothingIsRefused) {
  auto nameless = heart_tree();
  for (geometry::Vessel& vessel : nameless.vessels) vessel.name = "V" + std::to_string(vessel.id);
  EXPECT_THROW(fit_trees(nameless, nameless), InvalidInput);
  TreeMatchOptions options;
  options.reach_mm = 0.0;
  EXPECT_THROW(match_trees(heart_tree(), heart_tree(), known_motion(), options), InvalidInput);
  EXPECT_THROW(match_trees(heart_tree(), heart_tree(),
                           [](const Vec3&) -> Vec3 { return Vec3::Constant(std::nan("")); }),
               InvalidInput);
}

}  // namespace
}  // namespace ostia::analysis
