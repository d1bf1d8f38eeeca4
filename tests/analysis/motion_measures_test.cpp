// What one branch does, against helices, rings and tubes that are known at all times.

#include "ostia/analysis/motion_measures.h"

#include "moving_shapes.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"

#include <gmock/gmock.h>

namespace ostia::analysis {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::HeartBeat;
using testing::Helix;
using testing::Motion;
using M = MotionMeasure;
using L = LocalMeasure;

TEST(MotionMeasures, AFollowedHelixIsMeasuredExactly) {
  const Helix helix;
  const HeartBeat beat;
  const TreeMotion motion = measure_motion(testing::followed(testing::apart({helix.points(100.0)}), beat));
  const BranchMotion& branch = motion.branches.at(0);
  EXPECT_NEAR(branch[M::curvature_mean].at_template, helix.curvature(), 1e-4 * helix.curvature());
  for (std::size_t k = 0; k < motion.phases.size(); ++k) {
    const double phase = motion.phases[k];
    const Helix then = beat(helix, phase);
    EXPECT_NEAR(branch[M::stretch].values[k], beat.stretch(helix, phase), 1e-5);
    EXPECT_NEAR(branch[M::length].values[k], 100.0 * beat.stretch(helix, phase), 2e-3);
    EXPECT_NEAR(branch[M::torsion_total].values[k],
                360.0 / testing::whole_turn * then.torsion() * 100.0 * beat.stretch(helix, phase), 0.1);
    for (std::size_t i = 0; i < branch.s_mm.size(); ++i) {
      EXPECT_NEAR(branch[L::stretch].values[k][i], beat.stretch(helix, phase), 1e-4);
      EXPECT_NEAR(branch[L::curvature].values[k][i] / then.curvature(), 1.0, 1e-3);
      EXPECT_NEAR(branch[L::torsion].values[k][i] / then.torsion(), 1.0, 5e-3);
    }
  }
}

/// Worst relative errors over all phases and points of a helix that a cage carries.
struct Errors {
  double stretch_change = 0.0, curvature = 0.0, torsion = 0.0, torsion_mean = 0.0;
};

Errors errors_of_carried(const Helix& helix, const HeartBeat& beat, double length_mm) {
  const geometry::VesselTree rest = testing::apart({helix.points(length_mm)});
  const motion::MovingCage cage(testing::cage_of(rest, beat, testing::heart_box));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(20)));
  const BranchMotion& branch = motion.branches.at(0);
  Errors errors;
  const double largest_change = std::abs(beat.stretch(helix, 0.5) - 1.0);
  for (std::size_t k = 0; k < motion.phases.size(); ++k) {
    const double phase = motion.phases[k];
    const Helix then = beat(helix, phase);
    const auto add = [](double& worst, double error) { worst = std::max(worst, std::abs(error)); };
    add(errors.torsion_mean, branch[M::torsion_mean].values[k] / then.torsion() - 1.0);
    for (std::size_t i = 0; i < branch.s_mm.size(); ++i) {
      add(errors.stretch_change,
          (branch[L::stretch].values[k][i] - beat.stretch(helix, phase)) / largest_change);
      add(errors.curvature, branch[L::curvature].values[k][i] / then.curvature() - 1.0);
      add(errors.torsion, branch[L::torsion].values[k][i] / then.torsion() - 1.0);
    }
  }
  return errors;
}

class CarriedHelix : public ::testing::TestWithParam<std::tuple<Helix, HeartBeat, double>> {};

TEST_P(CarriedHelix, IsMeasuredWithinTwoPercentAtAllPlacesAndTimes) {
  const auto& [helix, beat, length] = GetParam();
  const Errors errors = errors_of_carried(helix, beat, length);
  RecordProperty("stretch_change", std::to_string(errors.stretch_change));
  RecordProperty("curvature", std::to_string(errors.curvature));
  RecordProperty("torsion", std::to_string(errors.torsion));
  EXPECT_LT(errors.stretch_change, 0.02);
  EXPECT_LT(errors.curvature, 0.02);
  EXPECT_LT(errors.torsion, 0.02);
  EXPECT_LT(errors.torsion_mean, 0.005);
}

INSTANTIATE_TEST_SUITE_P(
    Shapes, CarriedHelix,
    ::testing::Values(std::tuple{Helix{}, HeartBeat{}, 100.0},
                      std::tuple{Helix{8.0, testing::whole_turn / 60.0}, HeartBeat{-0.1, 0.15, -0.006}, 80.0},
                      std::tuple{Helix{20.0, -testing::whole_turn / 90.0}, HeartBeat{0.1, 0.0, 0.004}, 20.0},
                      std::tuple{Helix{30.0, testing::whole_turn / 180.0}, HeartBeat{0.2, 0.1, 0.003},
                                 60.0}));

/// 300 degrees of a circle about z.
std::vector<Vec3> ring(double radius_mm) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 300; ++i) {
    const double angle = i * std::numbers::pi / 180.0;
    points.emplace_back(radius_mm * std::cos(angle), radius_mm * std::sin(angle), 0.0);
  }
  return points;
}

TEST(MotionMeasures, ARingThatBreathesBendsByItsRadiusAndHasNoTorsion) {
  const Motion breathing = [](const Vec3& p, double phase) {
    return Vec3((1.0 + 0.25 * HeartBeat::share(phase)) * p);
  };
  const geometry::VesselTree rest = testing::apart({ring(20.0)});
  const motion::MovingCage cage(testing::cage_of(rest, breathing, testing::heart_box));
  const TreeMotion exact = measure_motion(testing::followed(rest, breathing));
  const TreeMotion carried = measure_motion(carried_tree(rest, cage, even_phases(20)));
  for (const TreeMotion* motion : {&exact, &carried}) {
    const BranchMotion& branch = motion->branches.at(0);
    for (std::size_t k = 0; k < 20; ++k) {
      const double scale = 1.0 + 0.25 * HeartBeat::share(motion->phases[k]);
      EXPECT_NEAR(branch[M::stretch].values[k], scale, 1e-4);
      EXPECT_NEAR(branch[M::curvature_max].values[k] * 20.0 * scale, 1.0, 0.005);
      EXPECT_NEAR(branch[M::torsion_total].values[k], 0.0, 0.1);
      EXPECT_NEAR(branch[M::displacement_mean].values[k], 20.0 * (scale - 1.0), 1e-3);
      EXPECT_NEAR(branch[M::displacement_max].values[k], 20.0 * (scale - 1.0), 1e-3);
      const double speed = 20.0 * 0.25 * std::numbers::pi *
                           std::abs(std::sin(testing::whole_turn * 0.05 * static_cast<double>(k)));
      EXPECT_NEAR(branch[M::speed_mean].values[k], speed / 0.8, 0.02);
      EXPECT_NEAR(branch[M::curvature_change].values[k], (1.0 - 1.0 / scale) / 20.0, 2e-5);
    }
  }
}

TEST(MotionMeasures, ATaperedTubeStretchesMoreHereThanThere) {
  const double wave = testing::whole_turn / 120.0, most = 8.0;
  const Motion uneven = [&](const Vec3& p, double phase) {
    return Vec3(p + most * HeartBeat::share(phase) * std::sin(wave * p.z()) * Vec3::UnitZ());
  };
  geometry::VesselTree rest = testing::apart({testing::straight({3, 4, 0}, {3, 4, 60})});
  for (std::size_t i = 0; i < rest.segments[0].axis.size(); ++i)
    rest.segments[0].axis.radius[i] = 2.0 - 0.02 * static_cast<double>(i) / 2.0;
  const motion::MovingCage cage(testing::cage_of(rest, uneven, testing::heart_box));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(20)));
  const BranchMotion& branch = motion.branches.at(0);
  const double largest = most * wave;  // of the local changes
  for (std::size_t i = 0; i < branch.s_mm.size(); ++i)
    EXPECT_NEAR(branch[L::stretch].values[10][i], 1.0 + largest * std::cos(wave * branch.s_mm[i]),
                0.05 * largest);
  EXPECT_NEAR(branch[M::stretch].values[10], 1.0, 0.002);  // the ends of the half wave stay
  EXPECT_NEAR(branch[M::stretch_largest].values[10], 1.0 + largest, 0.05 * largest);
  EXPECT_NEAR(branch[M::stretch_least].values[10], 1.0 - largest, 0.05 * largest);
  // A straight axis has a direction and no plane: no torsion, said by NaN.
  EXPECT_TRUE(std::isnan(branch[M::torsion_mean].values[10]));
  EXPECT_EQ(branch[M::torsion_share].values[10], 0.0);
}

TEST(MotionMeasures, TheWallsTurnAboutAStraightAxisIsItsTwist) {
  const HeartBeat beat{0.1, 0.1, 0.01};
  const geometry::VesselTree rest = testing::apart({testing::straight({0, 0, 10}, {0, 0, 70})});
  const motion::MovingCage cage(testing::cage_of(rest, beat, testing::heart_box));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(20)));
  const double degrees = 0.01 * 60.0 * 180.0 / std::numbers::pi;
  for (std::size_t k = 0; k < 20; ++k)
    EXPECT_NEAR(motion.branches[0][M::twist].values[k], degrees * HeartBeat::share(motion.phases[k]),
                0.05 * degrees);
  EXPECT_GT(motion.branches[0][M::twist].values[10], 30.0);  // a right-handed screw is positive
  EXPECT_NEAR(motion.branches[0][L::twist].values[10][60], degrees / 2.0, 0.05 * degrees);
  const TreeMotion followed = measure_motion(testing::followed(rest, beat));
  EXPECT_TRUE(std::isnan(followed.branches[0][M::twist].values[10]));  // an axis alone does not show it
}

TEST(MotionMeasures, SharpBendsOutOfAPlaneAreNoTwist) {
  std::vector<Vec3> points;  // two quarters of circles of 3 mm in planes across each other, then straight on
  const double step = 0.5 / 3.0, quarter = std::numbers::pi / 2.0;
  for (double angle = 0.0; angle < quarter; angle += step)
    points.emplace_back(3.0 * (1.0 - std::cos(angle)), 0.0, 3.0 * std::sin(angle));
  for (double angle = 0.0; angle < quarter; angle += step)
    points.emplace_back(3.0 + 3.0 * std::sin(angle) + 1e-3, 3.0 * (1.0 - std::cos(angle)), 3.0);
  for (int i = 1; i < 30; ++i) points.emplace_back(6.0, 3.0 + 0.5 * i, 3.0);
  const Motion shift = [](const Vec3& p, double phase) { return Vec3(p + 5.0 * phase * Vec3::UnitX()); };
  const geometry::VesselTree rest = testing::apart({points});
  const motion::MovingCage cage(testing::cage_of(rest, shift, testing::heart_box, 2));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(4)));
  for (const double v : motion.branches[0][M::twist].values) EXPECT_NEAR(v, 0.0, 0.01);
}

TEST(MotionMeasures, TurningTheWholeHeartChangesNoShape) {
  const Motion turning = [](const Vec3& p, double phase) {
    const Eigen::AngleAxisd turn(0.5 * HeartBeat::share(phase), Vec3(1, 2, 2) / 3.0);
    return Vec3(turn * p + 9.0 * HeartBeat::share(phase) * Vec3::UnitX());
  };
  const geometry::VesselTree rest = testing::apart({Helix{}.points(80.0)});
  const motion::MovingCage cage(testing::cage_of(rest, turning, testing::heart_box));
  const TreeMotion motion = measure_motion(carried_tree(rest, cage, even_phases(20)));
  const BranchMotion& branch = motion.branches[0];
  for (const double v : branch[M::stretch].values) EXPECT_NEAR(v, 1.0, 1e-6);
  for (const double v : branch[M::curvature_change].values) EXPECT_LT(v, 1e-6);
  for (const double v : branch[M::torsion_change].values) EXPECT_LT(v, 1e-5);
  for (const double v : branch[M::twist].values) EXPECT_NEAR(v, 0.0, 0.01);
  EXPECT_GT(branch[M::displacement_mean].values[10], 9.0);
}

/// Still from 50 to 90 % of the cycle, away at equal speeds and back before and after.
double away(double phase) {
  if (phase >= 0.5 && phase <= 0.9) return 0.0;
  const double since = phase > 0.9 ? phase - 0.9 : phase + 0.1;  // 0.6 in all
  return 10.0 * (1.0 - std::abs(since / 0.3 - 1.0));
}

TEST(MotionMeasures, RestsWhereItHardlyMoves) {
  const Motion shift = [](const Vec3& p, double phase) { return Vec3(p + away(phase) * Vec3::UnitY()); };
  const TreeMotion motion = measure_motion(
      testing::followed(testing::apart({testing::straight({0, 0, 0}, {0, 0, 40})}), shift, 100),
      {.rr_s = 1.0});
  ASSERT_FALSE(motion.rests.empty());
  // A millimetre on either side of what is still, at 33.3 mm a cycle: 0.47 to 0.93.
  EXPECT_NEAR(motion.rests[0].from, 0.47, 0.011);
  EXPECT_NEAR(motion.rests[0].to, 0.93, 0.003);
  EXPECT_LE(motion.rests[0].motion_mm, 1.0 + 1e-12);
  EXPECT_EQ(motion.branches[0].rests.size(), motion.rests.size());
  ASSERT_GE(motion.rests.size(), 2U);  // about the turning point: 1 mm to either side is 0.06 of the cycle
  EXPECT_NEAR(motion.rests[1].to - motion.rests[1].from, 0.06, 0.011);
  EXPECT_NEAR((motion.rests[1].to + motion.rests[1].from) / 2.0, 0.2, 0.011);
}

TEST(MotionMeasures, WhatNeverMovesRestsTheWholeCycle) {
  const Motion still = [](const Vec3& p, double) { return p; };
  const TreeMotion motion =
      measure_motion(testing::followed(testing::apart({testing::straight({0, 0, 0}, {0, 0, 40})}), still));
  ASSERT_EQ(motion.rests.size(), 1U);
  EXPECT_DOUBLE_EQ(motion.rests[0].to - motion.rests[0].from, 1.0);
}

TEST(MotionMeasures, ShortBranchesLackBendsAndSaySo) {
  const HeartBeat beat;
  const auto measured = [&](const std::vector<Vec3>& points) {
    return measure_motion(testing::followed(testing::apart({points}), beat));
  };
  const Helix helix{8.0, testing::whole_turn / 40.0};
  const TreeMotion some = measured(helix.points(6.0));  // reach 4: a bend, no torsion
  EXPECT_THAT(some.warnings, ElementsAre(HasSubstr("branch V1 is too short for torsion")));
  EXPECT_TRUE(std::isfinite(some.branches[0][M::curvature_mean].values[5]));
  EXPECT_TRUE(std::isnan(some.branches[0][M::torsion_mean].values[5]));
  EXPECT_TRUE(some.branches[0][L::torsion].values.empty());
  const TreeMotion none = measured(helix.points(1.5));  // four points
  EXPECT_THAT(none.warnings, ElementsAre(HasSubstr("curvature and torsion")));
  EXPECT_TRUE(std::isnan(none.branches[0][M::curvature_mean].values[5]));
  EXPECT_NEAR(none.branches[0][M::stretch].values[10], beat.stretch(helix, 0.5), 1e-3);
}

TEST(MotionMeasures, TheSameBitsForAnyNumberOfThreads) {
  const geometry::VesselTree rest = testing::fork(1.0);
  const HeartBeat beat;
  const motion::MovingCage cage(testing::cage_of(rest, beat, testing::heart_box, 3));
  std::vector<TreeMotion> runs;
  for (const int threads : {1, 0}) {
    core::set_max_threads(threads);
    runs.push_back(measure_motion(carried_tree(rest, cage, even_phases(16))));
  }
  core::set_max_threads(0);
  for (std::size_t b = 0; b < runs[0].branches.size(); ++b)
    for (const M m : {M::stretch, M::speed_max, M::curvature_mean, M::twist})
      EXPECT_EQ(runs[0].branches[b][m].values, runs[1].branches[b][m].values);
  EXPECT_EQ(runs[0].distances[0].distance.values, runs[1].distances[0].distance.values);
  EXPECT_EQ(runs[0].angles[0].angle.values, runs[1].angles[0].angle.values);
}

TEST(MotionMeasures, StopsWhenCancelled) {
  const MovingTree tree = testing::followed(testing::fork(1.0), HeartBeat{});
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(measure_motion(tree, {}, task), Cancelled);
}

TEST(MotionMeasures, RefusesOptionsThatMakeNoSense) {
  const MovingTree tree = testing::followed(testing::fork(1.0), HeartBeat{});
  for (const MotionMeasureOptions& options :
       {MotionMeasureOptions{.rr_s = 0.0}, MotionMeasureOptions{.reach_mm = -1.0},
        MotionMeasureOptions{.least_curvature_per_mm = 0.0}, MotionMeasureOptions{.arm_mm = 0.0},
        MotionMeasureOptions{.least_way_mm = -1.0}, MotionMeasureOptions{.rest_mm = 0.0},
        MotionMeasureOptions{.rr_s = std::nan("")}})
    EXPECT_THROW(measure_motion(tree, options), InvalidInput);
}

/// A tree about a heart: helices of several radii, as arteries go.
std::vector<Helix> helices_about_a_heart() {
  std::vector<Helix> helices;
  for (const double radius : {18.0, 22.0, 26.0, 30.0})
    helices.push_back({radius, testing::whole_turn / (100.0 + 2.0 * radius)});
  return helices;
}
geometry::VesselTree tree_of(const std::vector<Helix>& helices) {
  std::vector<std::vector<Vec3>> lines;
  for (const Helix& helix : helices) lines.push_back(helix.points(70.0));
  return testing::apart(lines);
}

/// Places that a fit errs by: waves of `mm` and `length_mm`, along each branch and at each phase others.
MovingTree disturbed(MovingTree tree, double mm, double length_mm) {
  for (std::size_t b = 0; b < tree.branches.size(); ++b) {
    MovingBranch& branch = tree.branches[b];
    for (std::size_t k = 0; k < branch.places.size(); ++k)
      for (std::size_t i = 0; i < branch.places[k].size(); ++i) {
        const double wave = testing::whole_turn * branch.s_mm[i] / length_mm;
        const auto turn = static_cast<double>(5 * b + 3 * k);
        branch.places[k][i] += mm * Vec3(std::sin(wave + turn), std::cos(1.1 * wave + 2.0 * turn),
                                         std::sin(0.9 * wave + 3.0 * turn));
      }
  }
  return tree;
}

TEST(TorsionSize, StaysWhereErrorsOfAFitSpoilTheTorsion) {
  const std::vector<Helix> helices = helices_about_a_heart();
  const geometry::VesselTree rest = tree_of(helices);
  const HeartBeat beat;
  const MovingTree exact = testing::followed(rest, beat);
  const TreeMotion truth = measure_motion(exact);
  const TreeMotion fitted = measure_motion(disturbed(exact, 0.05, 12.0));
  double worst = 0.0, worst_mean = 0.0, changes = 0.0;
  for (std::size_t b = 0; b < truth.branches.size(); ++b) {
    for (std::size_t k = 0; k < truth.phases.size(); ++k) {
      const double known = beat(helices[b], truth.phases[k]).torsion();
      const auto off = [&](const TreeMotion& motion, M measure) {
        return std::abs(motion.branches[b][measure].values[k] / known - 1.0);
      };
      EXPECT_LT(off(truth, M::torsion_size), 0.05) << "branch " << b << ", phase " << k;
      worst = std::max(worst, off(fitted, M::torsion_size));
      worst_mean = std::max(worst_mean, off(fitted, M::torsion_mean));
      changes = std::max(changes, std::abs(known / helices[b].torsion() - 1.0));
    }
  }
  RecordProperty("worst", std::to_string(worst));
  RecordProperty("worst_mean", std::to_string(worst_mean));
  EXPECT_GT(changes, 0.1);  // the template's own would be off by more
  EXPECT_LT(worst, 0.05);
  EXPECT_GT(worst_mean, 0.5);
}

TEST(TorsionSize, IsThatOfTheHelixAtTheTemplateAndInTheMirror) {
  const Helix right, left{right.a, -right.k};
  const TreeMotion motion =
      measure_motion(testing::followed(testing::apart({right.points(80.0), left.points(80.0)}), HeartBeat{}));
  for (const BranchMotion& branch : motion.branches)
    EXPECT_NEAR(branch[M::torsion_size].at_template, right.torsion(), 1e-3 * right.torsion());
}

TEST(MotionMeasures, EveryMeasureHasANameOfItsOwn) {
  std::vector<std::string> names;
  for (std::size_t m = 0; m < branch_measure_count; ++m) names.push_back(name_of(static_cast<M>(m)).name);
  std::sort(names.begin(), names.end());
  EXPECT_EQ(std::unique(names.begin(), names.end()), names.end());
  EXPECT_EQ(name_of(M::twist).name, "twist");
  EXPECT_EQ(name_of(L::twist).name, "twist");
}

}  // namespace
}  // namespace ostia::analysis
