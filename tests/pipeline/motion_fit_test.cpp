#include "ostia/pipeline/motion_fit.h"

#include "beating_tree.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/motion/moving_cage.h"

#include <gmock/gmock.h>

#include <algorithm>
#include <atomic>
#include <functional>
#include <string>
#include <thread>

namespace ostia::pipeline {
namespace {

using geometry::PhaseOrigin;
using geometry::Vec3;
using motion::testing::amount_at;
using motion::testing::still_tree;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

std::vector<PhaseSurface> beating_tree(int count) {
  std::vector<PhaseSurface> phases;
  for (motion::testing::BeatingPhase& one : motion::testing::beating_tree(count))
    phases.push_back({one.phase, one.name, std::move(one.surface)});
  return phases;
}

MotionFitOptions coarse() {
  MotionFitOptions options;
  options.registration.depth = 3;
  options.registration.most_rounds = 6;
  return options;
}

/// Of the carried template to the known motion.
motion::testing::Error error_at(const MotionFit& fit, double phase) {
  const motion::MovingCage cage(fit.motion);
  const motion::CarriedPoints carried(cage.grid(), fit.template_shape.points);
  return motion::testing::vertex_error(
      still_tree(), {carried.places(cage.at(phase)), fit.template_shape.triangles}, amount_at(phase));
}

class MotionFitting : public ::testing::Test {
 protected:
  static const MotionFit& whole() {
    static const MotionFit fit = fit_motion(beating_tree(8), coarse());
    return fit;
  }
};

TEST_F(MotionFitting, FollowsEveryPhaseOfABeat) {
  const MotionFit& fit = whole();
  ASSERT_EQ(fit.motion.phases.size(), 8U);
  ASSERT_EQ(fit.phases.size(), 8U);
  EXPECT_EQ(fit.motion.template_phase, 0.75);
  EXPECT_EQ(fit.template_index, 6U);
  EXPECT_LT(motion::testing::vertex_error(still_tree(), fit.template_shape, 0.0).worst, 1e-9);
  for (std::size_t k = 0; k < 8; ++k) {
    const PhaseFit& one = fit.phases[k];
    EXPECT_EQ(one.origin, k == 6 ? PhaseOrigin::at_rest : PhaseOrigin::fitted);
    EXPECT_EQ(one.origin, fit.motion.phases[k].origin);
    EXPECT_EQ(one.phase, fit.motion.phases[k].phase);
    EXPECT_GT(one.report.paired_share, 0.75);  // coarse triangles
    EXPECT_GT(one.report.least_jacobian, 0.0);
    EXPECT_LE(error_at(fit, one.phase).mean, 0.3) << one.phase;
  }
  EXPECT_EQ(fit.motion.phases[6].control_points, geometry::rest_points(fit.motion.grid));
  EXPECT_THAT(fit.warnings, IsEmpty());
}

// Between the phases the spline goes on as the heart does.
TEST_F(MotionFitting, KnowsWhatLiesBetweenThePhases) {
  for (const double phase : {0.0625, 0.31, 0.97}) EXPECT_LE(error_at(whole(), phase).mean, 0.35) << phase;
}

TEST_F(MotionFitting, ByThePapersDescentToo) {
  MotionFitOptions options = coarse();
  options.method = MotionMethod::gradient_descent;
  options.registration.depth = 2;
  const MotionFit fit = fit_motion(beating_tree(4), options);
  EXPECT_EQ(fit.motion.grid.cells, 4);
  EXPECT_EQ(fit.motion.phases[3].control_points, geometry::rest_points(fit.motion.grid));
  EXPECT_LE(error_at(fit, 0.0).mean, 0.2);
  options.method = MotionMethod::gauss_newton;
  EXPECT_NE(fit.motion.phases[0].control_points,
            fit_motion(beating_tree(4), options).motion.phases[0].control_points);
}

TEST_F(MotionFitting, DoesNotDependOnOrderOrThreads) {
  std::vector<PhaseSurface> phases = beating_tree(4);
  core::set_max_threads(1);
  const MotionFit one = fit_motion(phases, coarse());
  core::set_max_threads(0);
  std::ranges::reverse(phases);
  const MotionFit all = fit_motion(phases, coarse());
  for (std::size_t k = 0; k < 4; ++k)
    EXPECT_EQ(one.motion.phases[k].control_points, all.motion.phases[k].control_points);
}

// Phase 20 % is half a cycle off the template at 70 %, ahead and behind, to within rounding.
TEST_F(MotionFitting, RegistersAPhaseHalfACycleOffOnOneWayAlone) {
  MotionFitOptions options = coarse();
  options.template_phase = 0.7;
  options.registration.depth = options.registration.most_rounds = 2;
  const std::vector<PhaseSurface> ten = beating_tree(10);
  std::vector<PhaseSurface> phases = {ten[0], ten[2], ten[3], ten[7]};
  core::set_max_threads(1);
  const MotionFit all = fit_motion(phases, options);
  phases[2].surface = {};  // the other way
  const MotionFit ahead = fit_motion(phases, options);
  core::set_max_threads(0);
  ASSERT_EQ(all.motion.template_phase, 0.7);
  ASSERT_EQ(all.phases[1].origin, PhaseOrigin::fitted);
  EXPECT_EQ(all.motion.phases[1].control_points, ahead.motion.phases[1].control_points);
  EXPECT_NE(all.motion.phases[2].control_points, ahead.motion.phases[2].control_points);
}

TEST_F(MotionFitting, EachPhaseHasItsPartOfTheProgress) {
  core::TaskContext task;
  std::atomic<bool> done{false};
  double least = 1.0;  // in any phase but the first
  std::thread watcher([&] {
    std::string first;
    while (!done) {
      const std::string stage = task.stage();
      if (!stage.starts_with("registering ")) continue;
      if (first.empty()) first = stage;
      if (stage != first) least = std::min(least, task.progress());
    }
  });
  core::set_max_threads(1);
  MotionFitOptions options = coarse();
  options.registration.depth = 2;
  fit_motion(beating_tree(5), options, task);
  core::set_max_threads(0);
  done = true;
  watcher.join();
  EXPECT_LT(least, 0.9);
  EXPECT_EQ(task.progress(), 1.0);
}

TEST_F(MotionFitting, MarksAndBridgesAGap) {
  std::vector<PhaseSurface> phases = beating_tree(8);
  phases.erase(phases.begin() + 2);
  const MotionFit fit = fit_motion(phases, coarse());
  ASSERT_EQ(fit.phases.size(), 8U);
  EXPECT_EQ(fit.phases[2].origin, PhaseOrigin::bridged);
  EXPECT_EQ(fit.motion.phases[2].origin, PhaseOrigin::bridged);
  EXPECT_THAT(fit.phases[2].why, HasSubstr("gap"));
  EXPECT_THAT(fit.warnings, ElementsAre(HasSubstr("phase 25 %: a gap")));
  EXPECT_LE(error_at(fit, 0.25).mean, 0.6);
  EXPECT_GT(fit.phases[2].report.least_jacobian, 0.0);
  // The bridge lies on the spline through the others: without it nothing changes.
  geometry::CageMotion without = fit.motion;
  without.phases.erase(without.phases.begin() + 2);
  const auto a = motion::MovingCage(fit.motion).at(0.3), b = motion::MovingCage(without).at(0.3);
  for (std::size_t i = 0; i < a.size(); ++i) ASSERT_LT((a[i] - b[i]).norm(), 1e-9);
}

TEST_F(MotionFitting, BridgesAPhaseWithoutTheVesselAndOneThatShowsAnotherThing) {
  std::vector<PhaseSurface> phases = beating_tree(8);
  phases[1].surface = {};
  const geometry::AnalyticShape tube = geometry::straight_tube(40.0, 1.0);
  phases[3].surface = geometry::structured_surface(tube.tubes[0], 12, 1.0);
  for (Vec3& p : phases[3].surface.points) p += Vec3(25.0, 5.0, 0.0);
  const MotionFit fit = fit_motion(phases, coarse());
  EXPECT_EQ(fit.phases[1].origin, PhaseOrigin::bridged);
  EXPECT_EQ(fit.phases[1].why, "no vessel");
  EXPECT_EQ(fit.phases[3].origin, PhaseOrigin::bridged) << fit.phases[3].report.paired_share;
  EXPECT_THAT(fit.warnings, ElementsAre(HasSubstr("phase 12.5 %: no vessel"), HasSubstr("phase 37.5 %: ")));
  for (const std::size_t k : {0U, 2U, 4U, 5U, 7U}) EXPECT_EQ(fit.phases[k].origin, PhaseOrigin::fitted) << k;
  EXPECT_LE(error_at(fit, 0.5).mean, 0.4);  // those behind it are not led astray
}

TEST_F(MotionFitting, TakesTheNearestPhaseAsTheTemplateAndSaysSo) {
  std::vector<PhaseSurface> phases = beating_tree(8);
  phases.resize(4);
  const MotionFit fit = fit_motion(phases, coarse());
  EXPECT_EQ(fit.motion.template_phase, 0.0);
  EXPECT_THAT(fit.warnings, ::testing::Contains(HasSubstr("no phase 75 %: 0 % is the template")));
  EXPECT_THAT(fit.warnings, ::testing::Contains(HasSubstr("nothing between the phases 37.5 % and 0 %")));
}

std::string motion_fit_refusal(const std::function<void()>& call) {
  try {
    call();
  } catch (const InvalidInput& error) {
    return error.what();
  }
  return "not refused";
}

TEST_F(MotionFitting, RefusesWhatIsNoCycleOfOneHeart) {
  const auto told = [](const std::function<void(std::vector<PhaseSurface>&)>& change) {
    std::vector<PhaseSurface> phases = beating_tree(4);
    change(phases);
    return motion_fit_refusal([&] { fit_motion(phases, coarse()); });
  };
  using Phases = std::vector<PhaseSurface>;
  EXPECT_THAT(told([](Phases& p) { p.resize(1); }), HasSubstr("three phases"));
  EXPECT_THAT(told([](Phases& p) { p.resize(2); }), HasSubstr("there are 2"));
  EXPECT_THAT(told([](Phases& p) { p[0].surface = p[1].surface = {}; }), HasSubstr("there are 2 (4 in all)"));
  EXPECT_THAT(told([](Phases& p) { p[2].phase = 0.25; }),
              AllOf(HasSubstr("phase_25.vtp"), HasSubstr("phase_50.vtp"), HasSubstr("the same phase")));
  EXPECT_THAT(told([](Phases& p) { p[2].phase = 1.0; }), HasSubstr("phase_50.vtp"));
  EXPECT_THAT(told([](Phases& p) {
                for (PhaseSurface& one : p)
                  for (Vec3& q : one.surface.points) q /= 1000.0;
              }),
              AllOf(HasSubstr("phase_0.vtp"), HasSubstr("--units")));
  EXPECT_THAT(told([](Phases& p) {
                for (Vec3& q : p[1].surface.points) q /= 10.0;
              }),
              AllOf(HasSubstr("phase_25.vtp"), HasSubstr("different units")));
  EXPECT_THAT(told([](Phases& p) {
                for (Vec3& q : p[1].surface.points) q.x() += 500.0;
              }),
              AllOf(HasSubstr("phase_25.vtp"), HasSubstr("another patient")));
  EXPECT_THAT(told([](Phases& p) { p[1].surface.points[3].z() = std::nan(""); }),
              AllOf(HasSubstr("phase_25.vtp"), HasSubstr("not a number")));
  MotionFitOptions options = coarse();
  options.registration.depth = 9;
  EXPECT_THAT(motion_fit_refusal([&] { fit_motion(beating_tree(4), options); }), HasSubstr("depth"));
}

TEST_F(MotionFitting, Cancels) {
  core::TaskContext task;
  task.cancel();
  EXPECT_THROW(fit_motion(beating_tree(4), coarse(), task), Cancelled);
}

TEST(MissingPhases, AreFoundInEvenlySpacedOnesAlone) {
  EXPECT_THAT(missing_phases({0.0, 0.05, 0.1, 0.2, 0.25}), IsEmpty()) << "too few for a step of 5 %";
  std::vector<double> twenty;
  for (int k = 0; k < 20; ++k)
    if (k != 7) twenty.push_back(k / 20.0);
  EXPECT_THAT(missing_phases(twenty), ElementsAre(::testing::DoubleNear(0.35, 1e-12)));
  twenty.erase(twenty.begin());  // the first one: only the cycle's end tells
  EXPECT_THAT(missing_phases(twenty),
              ElementsAre(::testing::DoubleNear(0.0, 1e-12), ::testing::DoubleNear(0.35, 1e-12)));
  EXPECT_THAT(missing_phases({0.0, 0.25, 0.5, 0.75}), IsEmpty());
  std::vector<double> sixths;  // 1/6 + 5 * 1/6 is 1 - 2^-53
  for (int k = 1; k < 6; ++k) sixths.push_back(k / 6.0);
  EXPECT_THAT(missing_phases(sixths), ElementsAre(0.0)) << "no phase just below the cycle's end";
  EXPECT_THAT(missing_phases({0.0, 0.3, 0.47, 0.9}), IsEmpty()) << "not evenly spaced";
  EXPECT_THAT(missing_phases({0.7, 0.75, 0.8}), IsEmpty()) << "a window of the cycle";
}

TEST(PercentText, IsShort) {
  EXPECT_EQ(percent_text(0.35), "35 %");
  EXPECT_EQ(percent_text(0.125), "12.5 %");
  EXPECT_EQ(percent_text(0.0), "0 %");
}

}  // namespace
}  // namespace ostia::pipeline
