// Branches read from the aorta: Y-junctions of known calibres.

#include "ostia/analysis/ostial_way.h"

#include "walls.h"
#include "y_junction.h"

#include "ostia/core/error.h"
#include "ostia/lumen/edit.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace ostia::analysis {
namespace {

using testing::Narrowing;
using testing::Solved;
using testing::YJunction;

TEST(OstialWay, LeadsThroughTheParentAndBothWaysBetweenVesselsAndAbscissas) {
  const YJunction y;
  const Solved solved = y.solved();
  const std::vector<WayStretch> way = ostial_way(solved.model, y.side_id);
  ASSERT_EQ(way.size(), 2u);
  EXPECT_EQ(way[0].vessel, y.main_id);
  EXPECT_EQ(way[1].vessel, y.side_id);
  EXPECT_EQ(way[0].from_mm, 0.0);
  EXPECT_NEAR(way[0].to_mm, y.joint_mm, 1e-6);
  EXPECT_EQ(way[0].to_mm, way[1].from_mm);
  const geometry::AxisCurve &main = *lumen::vessel(solved.model, y.main_id).axis,
                            &side = *lumen::vessel(solved.model, y.side_id).axis;
  EXPECT_EQ(way[1].to_mm, side.length());
  // The parent's abscissa is the way's, at the same place.
  for (double s = 0.0; s < y.joint_mm - 0.01; s += 0.5) {
    EXPECT_EQ(lumen::owner_at(solved.model.tree, y.side_id, s), y.main_id);
    EXPECT_NEAR((main.point(s) - side.point(s)).norm(), 0.0, 0.02) << s;
    EXPECT_NEAR(main.nearest_foot(side.point(s)).s_mm, s, 0.02) << s;
  }
  EXPECT_EQ(lumen::owner_at(solved.model.tree, y.side_id, y.joint_mm + 0.5), y.side_id);
  EXPECT_EQ(ostial_way(solved.model, y.main_id).size(), 1u);
  EXPECT_THROW(ostial_way(solved.model, 99), InvalidInput);
}

TEST(OstialWay, TheOstiumIsWhereTheAxisLeavesTheParentsLumen) {
  const YJunction y;
  const Solved solved = y.solved();
  const Ostium ostium = ostium_of(solved.model, solved.surface_of(), y.side_id);
  EXPECT_EQ(ostium.parent, y.main_id);
  EXPECT_NEAR(ostium.joint_mm, y.joint_mm, 1e-6);
  // 2 mm of radius at 45 degrees.
  EXPECT_NEAR(ostium.ostium_mm - ostium.joint_mm, y.main_radius_mm * std::numbers::sqrt2, 0.35);
  EXPECT_EQ(ostium_of(solved.model, solved.surface_of(), y.main_id).parent, -1);
  EXPECT_THROW(ostium_of(solved.model, {}, y.side_id), InvalidInput);
}

TEST(OstialWay, GoesOverTheJointWithoutAJump) {
  const YJunction y;
  const Solved solved = y.solved();
  const geometry::AxisCurve& axis = *lumen::vessel(solved.model, y.side_id).axis;
  constexpr double step_mm = 0.1;
  for (double s = y.joint_mm - 4.0; s < y.joint_mm + 4.0; s += step_mm) {
    EXPECT_NEAR((axis.point(s + step_mm) - axis.point(s)).norm(), step_mm, 0.01) << s;
    const geometry::Frame a = axis.frame(s), b = axis.frame(s + step_mm);
    EXPECT_GT(a.tangent.dot(b.tangent), std::cos(0.35)) << s;
    EXPECT_GT(a.normal.dot(b.normal), std::cos(0.35)) << s;
  }
  const LumenProfile profile = lumen_profile(solved.model, solved.surface_of(), y.side_id, {.step_mm = 0.25});
  const ReferenceLine line = reference_line(
      profile, {}, reading_from_ostium(ostia_of(solved.model, solved.surface_of(), y.side_id)));
  const LumenProfile read = read_through(profile, line);
  const double calibre_step = 2.0 * (y.main_radius_mm - y.side_radius_mm);
  double largest = 0.0, largest_reference = 0.0, before = 0.0;
  for (std::size_t i = 4; i + 5 < read.sections.size(); ++i) {
    largest = std::max(largest, std::abs(read.sections[i + 1].diameter_mm - read.sections[i].diameter_mm));
    before =
        std::max(before, std::abs(profile.sections[i + 1].diameter_mm - profile.sections[i].diameter_mm));
    largest_reference = std::max(largest_reference, std::abs(line.diameter_mm[i + 1] - line.diameter_mm[i]));
  }
  EXPECT_GT(before, 0.7 * calibre_step);  // what it would be
  EXPECT_LT(largest, 0.2 * calibre_step);
  EXPECT_LT(largest_reference, 0.2 * calibre_step);
  EXPECT_TRUE(find_stenoses(profile, line).empty());
  // Nothing but the mouth is another; a quarter of a millimetre before the joint the axis begins to turn.
  for (std::size_t i = 0; i < read.sections.size(); ++i) {
    const double s = read.sections[i].s_mm;
    if (s >= line.joints[0].joint_mm - 0.25 && s <= line.joints[0].ostium_mm + 0.25) continue;
    EXPECT_EQ(read.sections[i].diameter_mm, profile.sections[i].diameter_mm) << s;
  }
}

TEST(OstialWay, ABranchOfABranchGoesOverBothJointsWithoutAStep) {
  const testing::TwiceBranched y;
  const Solved solved = y.solved();
  const std::vector<WayStretch> way = ostial_way(solved.model, y.second_id);
  ASSERT_EQ(way.size(), 3u);
  EXPECT_EQ(way[1].vessel, y.side_id);
  const std::vector<Ostium> ostia = ostia_of(solved.model, solved.surface_of(), y.second_id);
  ASSERT_EQ(ostia.size(), 2u);
  EXPECT_EQ(ostia[0].parent, y.main_id);
  EXPECT_EQ(ostia[1].parent, y.side_id);
  EXPECT_NEAR(ostia[0].joint_mm, y.joint_mm, 1e-6);
  EXPECT_NEAR(ostia[1].joint_mm, y.second_joint_mm(), 0.03);
  EXPECT_NEAR(ostia[0].ostium_mm - ostia[0].joint_mm, y.main_radius_mm * std::numbers::sqrt2, 0.4);
  EXPECT_NEAR(ostia[1].ostium_mm - ostia[1].joint_mm, y.side_radius_mm * std::numbers::sqrt2, 0.4);
  EXPECT_EQ(ostia[1].ostium_mm, ostium_of(solved.model, solved.surface_of(), y.second_id).ostium_mm);
  // Sections as near as they can be: what is steep is no step.
  const LumenProfile profile =
      lumen_profile(solved.model, solved.surface_of(), y.second_id, {.step_mm = 0.05});
  const auto steps = [&](const LumenProfile& of, const ReferenceLine& line, double joint_mm) {
    double diameter = 0.0, reference = 0.0;
    for (std::size_t i = 0; i + 1 < of.sections.size(); ++i) {
      if (std::abs(of.sections[i].s_mm - joint_mm) > 6.0) continue;
      diameter = std::max(diameter, std::abs(of.sections[i + 1].diameter_mm - of.sections[i].diameter_mm));
      reference = std::max(reference, std::abs(line.diameter_mm[i + 1] - line.diameter_mm[i]));
    }
    return std::pair(diameter, reference);
  };
  const ReferenceLine line = reference_line(profile, {}, reading_from_ostium(ostia));
  const LumenProfile read = read_through(profile, line);
  // Of the last joint alone, as it was: the first one steps.
  const ReferenceLine last = reference_line(profile, {}, reading_from_ostium({ostia[1]}));
  EXPECT_GT(steps(read_through(profile, last), last, y.joint_mm).first, 0.3);
  for (const Ostium& one : ostia) {
    const auto [diameter, reference] = steps(read, line, one.joint_mm);
    EXPECT_LE(diameter, 0.05) << one.joint_mm;
    EXPECT_LE(reference, 0.05) << one.joint_mm;
  }
  // Each vessel's own calibre beside the mouths.
  EXPECT_NEAR(at(read, 10.0).diameter_mm, 2.0 * y.main_radius_mm, 0.05);
  EXPECT_NEAR(at(read, y.joint_mm + 9.0).diameter_mm, 2.0 * y.side_radius_mm, 0.05);
  EXPECT_NEAR(at(read, y.second_joint_mm() + 9.0).diameter_mm, 2.0 * y.second_radius_mm, 0.05);
  EXPECT_TRUE(find_stenoses(profile, line).empty());
  // Image and contour turn with the axis: it and its frames are one smooth curve over both joints.
  const geometry::AxisCurve& axis = *lumen::vessel(solved.model, y.second_id).axis;
  for (const Ostium& one : ostia)
    for (double s = one.joint_mm - 3.0; s < one.joint_mm + 3.0; s += 0.1) {
      EXPECT_NEAR((axis.point(s + 0.1) - axis.point(s)).norm(), 0.1, 0.01) << s;
      EXPECT_GT(axis.frame(s).normal.dot(axis.frame(s + 0.1).normal), std::cos(0.35)) << s;
    }
}

TEST(OstialWay, JointsWhoseLuminaMeetAreOne) {
  const LumenProfile profile = testing::profile_of(40.0, 0.25, [](double s) {
    return s < 10.0 ? 4.0 : s < 11.0 ? 3.1 : 2.0;
  });
  const ReferenceLine line = reference_line(profile, {}, {.joints = {{11.0, 13.0}, {10.0, 12.0}}});
  ASSERT_EQ(line.joints.size(), 1u);
  EXPECT_EQ(line.joints[0].joint_mm, 10.0);
  EXPECT_EQ(line.joints[0].ostium_mm, 13.0);
  const LumenProfile read = read_through(profile, line);
  for (std::size_t i = 0; i + 1 < read.sections.size(); ++i) {
    EXPECT_LE(std::abs(read.sections[i + 1].diameter_mm - read.sections[i].diameter_mm), 0.16) << i;
    EXPECT_LE(std::abs(line.diameter_mm[i + 1] - line.diameter_mm[i]), 0.16) << i;
  }
  EXPECT_TRUE(find_stenoses(profile, line).empty());
}

TEST(OstialWay, AnOstialLesionIsMeasuredAgainstTheBranchsOwnCalibre) {
  YJunction y;
  y.side = Narrowing{y.ostium_mm() + 1.5, 6.0, 0.6};
  const Solved solved = y.solved();
  const LumenProfile profile = lumen_profile(solved.model, solved.surface_of(), y.side_id);
  const ReferenceLine line = reference_line(
      profile, {}, reading_from_ostium(ostia_of(solved.model, solved.surface_of(), y.side_id)));
  const std::vector<Stenosis> found = find_stenoses(profile, line);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NEAR(found[0].throat_mm, y.ostium_mm() + 1.5, 0.6);
  EXPECT_NEAR(found[0].reference_diameter_mm, 2.0 * y.side_radius_mm, 0.12);
  EXPECT_NEAR(found[0].diameter_percent, 60.0, 5.0);
  EXPECT_GE(found[0].from_mm, line.joints[0].ostium_mm - 1e-9);
  EXPECT_GE(found[0].proximal_mm, line.joints[0].ostium_mm - 1e-9);  // not in the parent, which is wider
}

TEST(OstialWay, ALesionOfTheParentIsTheParents) {
  YJunction y;
  y.main = Narrowing{y.joint_mm - 0.5, 6.0, 0.6};
  const Solved solved = y.solved();
  const LumenProfile profile = lumen_profile(solved.model, solved.surface_of(), y.side_id);
  const Ostium ostium = ostium_of(solved.model, solved.surface_of(), y.side_id);
  const std::vector<Stenosis> found =
      find_stenoses(profile, reference_line(profile, {}, reading_from_ostium({ostium})));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_LT(found[0].throat_mm, y.joint_mm);
  EXPECT_LT(found[0].to_mm, ostium.ostium_mm);
}

TEST(OstialWay, AnEditOnTheParentsPartIsTheParents) {
  const YJunction y;
  const Solved solved = y.solved();
  const geometry::AxisCurve& axis = *lumen::vessel(solved.model, y.side_id).axis;
  const auto changed = [&](double s_mm) {
    lumen::SectionContour ring{.vessel = y.side_id, .s_mm = s_mm, .points = {}};
    for (int i = 0; i < 24; ++i) ring.points.push_back(axis.place(s_mm, 2.0 * testing::pi * i / 24.0, 1.0));
    std::vector<std::int32_t> vessels;
    for (const lumen::VesselChange& one : lumen::apply(solved.model, ring).changes)
      if (!one.added.empty()) vessels.push_back(one.vessel);
    return vessels;
  };
  EXPECT_EQ(changed(y.joint_mm - 6.0), std::vector{y.main_id});
  EXPECT_EQ(changed(y.joint_mm + 8.0), std::vector{y.side_id});
}

TEST(OstialWay, WithoutAMeasuredNeighbourTheProfileStaysAsItIs) {
  LumenProfile profile = testing::profile_of(20.0, 0.5, [](double s) { return s < 10.0 ? 4.0 : 2.0; });
  ReferenceLine line = reference_line(profile, {}, {.joints = {{10.0, 12.0}}});
  ASSERT_EQ(line.joints.size(), 1u);
  EXPECT_EQ(line.joints[0].joint_mm, 10.0);
  EXPECT_EQ(line.joints[0].ostium_mm, 12.0);
  EXPECT_NEAR(read_through(profile, line).sections[22].diameter_mm, 3.0, 0.3);
  profile.sections[24].found = false;
  EXPECT_EQ(read_through(profile, line).sections[22].diameter_mm, 2.0);
  line.joints.clear();
  EXPECT_EQ(read_through(profile, line).sections[22].diameter_mm, 2.0);
}

}  // namespace
}  // namespace ostia::analysis
