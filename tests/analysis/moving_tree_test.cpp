// Trees over the cycle: what they are made of, what lies between their branches, and what is refused.

#include "ostia/analysis/moving_tree.h"

#include "moving_shapes.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::HeartBeat;
using testing::Motion;

template <class Call>
std::string refusal(const Call& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "nothing was refused";
}

const Motion still = [](const Vec3& p, double) { return p; };

TEST(MovingTree, ASegmentBelongsToTheFirstVesselThatHasIt) {
  const MovingTree tree = testing::followed(testing::fork(1.0), still);
  ASSERT_EQ(tree.branches.size(), 2U);
  EXPECT_EQ(tree.branches[0].name, "main");
  EXPECT_NEAR(tree.branches[0].s_mm.back(), 50.0, 1e-9);
  EXPECT_NEAR(tree.branches[1].s_mm.back(), 20.0, 1e-9);
  ASSERT_EQ(tree.joints.size(), 1U);
  const Joint& joint = tree.joints[0];
  EXPECT_EQ(joint.node, 2);
  EXPECT_DOUBLE_EQ(joint.radius_mm, 1.0);
  ASSERT_EQ(joint.arms.size(), 3U);
  EXPECT_FALSE(joint.arms[0].distal);  // what leads to the root comes first
  EXPECT_NEAR(joint.arms[0].s_mm, 30.0, 1e-9);
  EXPECT_TRUE(joint.arms[1].distal && joint.arms[2].distal);
}

TEST(MovingTree, NamesAreMadeDifferentAndSegmentsWithoutVesselStay) {
  geometry::VesselTree rest = testing::fork(1.0);
  rest.vessels = {};
  EXPECT_THAT(testing::followed(rest, still).branches[2].name, "segment 13");
  rest = testing::apart({testing::straight({0, 0, 0}, {0, 0, 9}), testing::straight({5, 0, 0}, {5, 0, 9})});
  rest.vessels[0].name = rest.vessels[1].name = "LAD";
  const MovingTree tree = testing::followed(rest, still);
  EXPECT_NE(tree.branches[0].name, tree.branches[1].name);
  EXPECT_THAT(tree.branches[1].name, HasSubstr("LAD"));
}

TEST(MovingTree, TheCagesPlacesAreThoseOfTheSurfaceAndItsShapeIsNear) {
  const geometry::VesselTree rest = testing::fork(1.0);
  const HeartBeat beat;
  const motion::MovingCage cage(testing::cage_of(rest, beat, testing::heart_box));
  const MovingTree tree = carried_tree(rest, cage, even_phases(20));
  EXPECT_TRUE(tree.warnings.empty());
  const MovingBranch& branch = tree.branches[0];
  const motion::CarriedPoints carried(cage.grid(), branch.rest);
  const auto places = carried.places(cage.at(0.5));
  for (std::size_t i = 0; i < branch.rest.size(); ++i) {
    EXPECT_LT((branch.places[10][i] - places[i]).norm(), 1e-12);
    EXPECT_LT((branch.places[10][i] - beat(branch.rest[i], 0.5)).norm(), 0.05);
    EXPECT_LT((branch.shape[10][i] - beat(branch.rest[i], 0.5)).norm(), 0.05);
    EXPECT_NEAR((branch.beside[0][i] - branch.shape[0][i]).norm(), 1.0, 1e-9);
  }
  EXPECT_NEAR(tree.joints[0].arms[0].s_mm, 30.0, 0.01);
}

TEST(MovingTree, TellsHowMuchLiesOutsideOfTheCage) {
  const geometry::VesselTree rest = testing::apart({testing::straight({0, 0, 0}, {0, 0, 100})});
  geometry::CageMotion cage;
  cage.template_phase = 0.0;
  const auto around = [&](double top) {
    cage.grid = geometry::cage_around({Vec3(-20, -20, 0), Vec3(20, 20, top)}, 2, 0.0);
    cage.phases.clear();
    for (const double phase : even_phases(4))
      cage.phases.push_back({phase, geometry::rest_points(cage.grid), geometry::PhaseOrigin::fitted});
    return motion::MovingCage(cage);
  };
  EXPECT_THAT(carried_tree(rest, around(90.0), even_phases(4)).warnings,
              ElementsAre(HasSubstr("10.0 % of the axes lie outside of the motion's cage, up to 10.0 mm")));
  EXPECT_THAT(refusal([&] { carried_tree(rest, around(40.0), even_phases(4)); }),
              HasSubstr("up to 60.0 mm: they must be of the same heart"));
}

TEST(MovingTree, RefusesWhatCannotBeFollowed) {
  const geometry::VesselTree rest = testing::fork(1.0);
  EXPECT_THAT(refusal([] { even_phases(2); }), HasSubstr("3 to 1000"));
  EXPECT_THAT(refusal([&] {
                followed_tree(rest, 0.0, {0.0, 0.5}, {rest, rest});
              }),
              HasSubstr("at least three"));
  EXPECT_THAT(refusal([&] {
                followed_tree(rest, 0.0, {0.0, 0.5, 0.4}, {rest, rest, rest});
              }),
              HasSubstr("phase 2 is 0.4"));
  EXPECT_THAT(refusal([&] { followed_tree(rest, 0.0, {0.0, 0.3, 0.6}, {rest, rest}); }), HasSubstr("at 2"));
  geometry::VesselTree other = rest;
  other.segments[1].axis.points.pop_back();
  EXPECT_THAT(refusal([&] {
                followed_tree(rest, 0.0, {0.0, 0.3, 0.6}, {rest, other, rest});
              }),
              HasSubstr("segment 12 has 41 points at the template and 40 at phase 1"));
  other.segments.pop_back();
  other.segments.pop_back();
  EXPECT_THAT(refusal([&] {
                followed_tree(rest, 0.0, {0.0, 0.3, 0.6}, {rest, rest, other});
              }),
              HasSubstr("phase 2 has no segment 12"));
  other = rest;
  other.segments[2].axis.points[3].x() = std::nan("");
  EXPECT_THAT(refusal([&] {
                followed_tree(rest, 0.0, {0.0, 0.3, 0.6}, {other, rest, rest});
              }),
              HasSubstr("not finite"));
  EXPECT_THAT(refusal([&] { followed_tree({}, 0.0, {0.0, 0.3, 0.6}, {{}, {}, {}}); }), HasSubstr("no axes"));
  const motion::MovingCage cage(testing::cage_of(rest, still, testing::heart_box, 1));
  EXPECT_THAT(refusal([&] { carried_tree(rest, cage, {0.1, 0.2}); }), HasSubstr("at least three"));
  EXPECT_THAT(refusal([&] { carried_tree(rest, cage, even_phases(3), 0.0); }), HasSubstr("0.05 to 5"));
  EXPECT_THAT(refusal([&] { carried_tree({}, cage, even_phases(3)); }), HasSubstr("no axes"));
}

TEST(MovingTree, StopsWhenCancelled) {
  const geometry::VesselTree rest = testing::fork(1.0);
  const motion::MovingCage cage(testing::cage_of(rest, still, testing::heart_box, 1));
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(carried_tree(rest, cage, even_phases(3), 0.5, task), Cancelled);
}

/// The arms of a fork at another angle, each as long as before.
MovingTree opening_fork() {
  std::vector<geometry::VesselTree> trees;
  for (const double phase : even_phases(20))
    trees.push_back(testing::fork(1.0 + 0.5 * HeartBeat::share(phase)));
  return followed_tree(testing::fork(1.0), 0.0, even_phases(20), trees);
}

TEST(MotionBetweenBranches, AForkThatOpensIsMeasuredExactly) {
  const TreeMotion motion = measure_motion(opening_fork());
  ASSERT_EQ(motion.angles.size(), 3U);
  EXPECT_EQ(motion.angles[0].name, "main proximal | main distal");
  EXPECT_EQ(motion.angles[1].name, "main proximal | side");
  EXPECT_EQ(motion.angles[2].name, "main distal | side");
  constexpr double degrees = 180.0 / std::numbers::pi;
  for (std::size_t k = 0; k < 20; ++k) {
    const double angle = 1.0 + 0.5 * HeartBeat::share(motion.phases[k]);
    EXPECT_NEAR(motion.angles[2].angle.values[k], degrees * angle, 1e-6);
    EXPECT_NEAR(motion.angles[1].angle.values[k], 180.0 - degrees * angle / 2.0, 1e-6);
    // Ten millimetres along the tree: five on either arm come nearest.
    EXPECT_NEAR(motion.distances.at(0).distance.values[k], 10.0 * std::sin(angle / 2.0), 1e-6);
    EXPECT_NEAR(motion.distances[0].s_first.values[k], 35.0, 1e-6);
    EXPECT_NEAR(motion.distances[0].s_second.values[k], 5.0, 1e-6);
  }
  EXPECT_NEAR(motion.angles[2].angle.at_template, degrees, 1e-6);
}

TEST(MotionBetweenBranches, AForkThatACageOpensIsMeasuredWithinFivePercent) {
  // z shrinks and x widens: straight arms stay straight, tan(angle / 2) grows.
  const Motion opening = [](const Vec3& p, double phase) {
    const double c = HeartBeat::share(phase);
    return Vec3((1.0 + 0.3 * c) * p.x(), p.y() + 0.002 * c * p.z() * p.z(), (1.0 - 0.1 * c) * p.z());
  };
  const geometry::VesselTree rest = testing::fork(1.0);
  const motion::MovingCage cage(testing::cage_of(rest, opening, testing::heart_box));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(20)));
  const TreeMotion exact = measure_motion(testing::followed(rest, opening));
  for (std::size_t a = 0; a < 3; ++a) {
    const double change = std::abs(exact.angles[a].angle.values[10] - exact.angles[a].angle.at_template);
    EXPECT_GT(change, 5.0);
    for (std::size_t k = 0; k < 20; ++k)
      EXPECT_NEAR(motion.angles[a].angle.values[k], exact.angles[a].angle.values[k], 0.05 * change);
  }
}

TEST(MotionBetweenBranches, LinesThatPassKnowTheirDistanceBetweenPoints) {
  // Two lines that cross at right angles, between points, 3 mm apart, and go apart by 4 mm.
  const Motion apart = [](const Vec3& p, double phase) {
    return Vec3(p + (p.z() > 1.0 ? 4.0 * HeartBeat::share(phase) : 0.0) * Vec3::UnitZ());
  };
  const geometry::VesselTree rest = testing::apart(
      {testing::straight({-10.2, 0, 0}, {10, 0, 0}, 1.0), testing::straight({0, -10.3, 3}, {0, 10, 3}, 1.0)});
  const TreeMotion motion = measure_motion(testing::followed(rest, apart));
  ASSERT_EQ(motion.distances.size(), 1U);
  EXPECT_TRUE(motion.angles.empty());
  EXPECT_NEAR(motion.distances[0].distance.at_template, 3.0, 1e-9);
  EXPECT_NEAR(motion.distances[0].s_first.at_template, 10.2, 1e-9);
  EXPECT_NEAR(motion.distances[0].s_second.at_template, 10.3, 1e-9);
  for (std::size_t k = 0; k < 20; ++k)
    EXPECT_NEAR(motion.distances[0].distance.values[k], 3.0 + 4.0 * HeartBeat::share(motion.phases[k]), 1e-9);
}

TEST(MotionBetweenBranches, BranchesThatAreTooShortHaveNeitherAngleNorDistance) {
  geometry::VesselTree rest = testing::fork(1.0, 1.5);
  rest.vessels = {{21, "main", {11, 12}}, {22, "side", {11, 13}}};
  const TreeMotion motion = measure_motion(testing::followed(rest, still), {.least_way_mm = 40.0});
  EXPECT_TRUE(std::isnan(motion.angles[2].angle.values[0]));
  EXPECT_TRUE(std::isnan(motion.distances[0].distance.values[0]));
  EXPECT_THAT(motion.warnings,
              ::testing::Contains(HasSubstr("the angle main distal | side is not measured")));
}

}  // namespace
}  // namespace ostia::analysis
