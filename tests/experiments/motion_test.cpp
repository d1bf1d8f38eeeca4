#include "ostia/experiments/motion.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/phantom/heartbeat.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

BeatingHeartOptions coarse() {
  BeatingHeartOptions options;
  options.phases = 4;
  options.template_points = 3000;
  options.target_points = 4000;
  options.phases_with_loss = 0.0;
  return options;
}

MotionOptions quick() {
  MotionOptions options;
  options.hearts = 1;
  options.heart = coarse();
  options.heart.phases_with_loss = 0.5;
  options.depths = {1, 2};
  options.depth = 2;
  options.methods = {MotionMethod::descent};
  options.compared_phases = {0.25};
  options.dice_resolution_mm = 0.4;
  return options;
}

TEST(SmoothField, HasDeviationOneAndItsLength) {
  double sum = 0.0, squares = 0.0, together = 0.0;
  int count = 0;
  for (std::uint64_t seed = 1; seed <= 40; ++seed) {
    const auto field = smooth_field(seed, 2.0);
    for (int i = 0; i < 50; ++i) {
      const Vec3 p(13.0 * i, 7.0 * (i % 7), -3.0 * i);
      const double a = field(p), b = field(p + Vec3(0.0, 2.0, 0.0));
      sum += a;
      squares += a * a;
      together += a * b;
      ++count;
    }
  }
  EXPECT_NEAR(sum / count, 0.0, 0.05);
  EXPECT_NEAR(squares / count, 1.0, 0.08);
  EXPECT_NEAR(together / count, std::exp(-0.5), 0.08);
}

TEST(BeatingHeart, TheTemplatesPhaseIsTheTemplate) {
  const BeatingHeart heart = beating_heart(coarse());
  ASSERT_EQ(heart.phases.size(), 4U);
  EXPECT_EQ(heart.template_phase, phantom::template_percent / 100.0);
  for (const HeartPhaseModel& phase : heart.phases) {
    ASSERT_EQ(phase.truth.size(), heart.model.points.size());
    double farthest = 0.0;
    for (std::size_t i = 0; i < phase.truth.size(); ++i)
      farthest = std::max(farthest, (phase.truth[i] - heart.model.points[i]).norm());
    if (phase.phase == heart.template_phase)
      EXPECT_EQ(farthest, 0.0);
    else
      EXPECT_GT(farthest, 1.0) << phase.phase;
  }
}

TEST(BeatingHeart, TheNoiseIsAsAskedFor) {
  BeatingHeartOptions options = coarse();
  options.noise_mm = 0.2;
  const BeatingHeart noisy = beating_heart(options);
  options.noise_mm = 0.0;
  const BeatingHeart smooth = beating_heart(options);
  double squares = 0.0;
  const auto& a = noisy.phases[1].segmented.points;
  const auto& b = smooth.phases[1].segmented.points;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(a.size())), 0.2, 0.04);
}

TEST(BeatingHeart, PhasesWithLossLackTheBranchThatIsNamed) {
  BeatingHeartOptions options = coarse();
  options.noise_mm = 0.0;
  const BeatingHeart whole = beating_heart(options);
  options.phases_with_loss = 1.0;
  const BeatingHeart lossy = beating_heart(options);
  for (std::size_t k = 0; k < 4; ++k) {
    EXPECT_TRUE(whole.phases[k].lost.empty());
    EXPECT_FALSE(lossy.phases[k].lost.empty());
    const auto left = lossy.phases[k].segmented.triangles.size(),
               all = whole.phases[k].segmented.triangles.size();
    EXPECT_LT(left, all);
    EXPECT_GT(left, all / 2);
    // What is left is where it was.
    const geometry::AabbTree tree(whole.phases[k].segmented);
    for (const Vec3& p : lossy.phases[k].segmented.points) ASSERT_LT(tree.closest(p).distance, 1e-9);
  }
}

TEST(MotionExperiment, RegistrationBringsTheTreeOverTheTruth) {
  const MotionOptions options = quick();
  const std::vector<MotionRun> runs = run_motion(options);
  const std::vector<MotionRow> rows = rows_of(runs, false);
  ASSERT_EQ(rows.front().method, MotionMethod::none);
  const auto deepest = std::find_if(rows.begin(), rows.end(), [](const MotionRow& row) {
    return row.method == MotionMethod::cage && row.depth == 2 && row.sampling == "all";
  });
  ASSERT_NE(deepest, rows.end());
  EXPECT_EQ(deepest->runs, 4U);
  EXPECT_GT(deepest->dice, rows.front().dice + 0.3);
  EXPECT_LT(deepest->distance_mm, 0.25 * rows.front().distance_mm);
  EXPECT_EQ(deepest->inverted_cells, 0U);
  EXPECT_EQ(deepest->new_intersections, 0U);
  const std::vector<MotionRow> compared = rows_of(runs, true);
  EXPECT_TRUE(std::any_of(compared.begin(), compared.end(),
                          [](const MotionRow& row) { return row.method == MotionMethod::descent; }));
  for (const MotionRow& row : compared) EXPECT_EQ(row.runs, 1U) << word(row.method) << row.depth;
}

TEST(MotionExperiment, TheSameForAnyNumberOfThreads) {
  MotionOptions options = quick();
  options.depths = {2};
  options.methods.clear();
  core::set_max_threads(1);
  const auto once = run_motion(options);
  core::set_max_threads(0);
  const auto again = run_motion(options);
  ASSERT_EQ(once.size(), again.size());
  for (std::size_t i = 0; i < once.size(); ++i) {
    EXPECT_EQ(once[i].distance_mm, again[i].distance_mm);
    EXPECT_EQ(once[i].dice, again[i].dice);
    EXPECT_EQ(once[i].vertex_mm, again[i].vertex_mm);
  }
}

TEST(MotionExperiment, TheReportHoldsAllRows) {
  MotionRun before, after;
  before.heart = after.heart = "heart 1";
  before.sampling = after.sampling = "all";
  before.dice = 0.25;
  after.method = MotionMethod::cage;
  after.depth = 4;
  after.dice = 0.95;
  const MotionOptions options;
  const auto json = nlohmann::json::parse(motion_json({before, after}, options));
  ASSERT_EQ(json.at("rows").size(), 2U);
  EXPECT_EQ(json.at("rows")[1].at("dice"), 0.95);
  EXPECT_NE(motion_text({before, after}).find("before registration"), std::string::npos);
}

TEST(MotionExperiment, WhatCannotBeStudiedIsRefused) {
  MotionOptions options = quick();
  options.depth = 3;
  EXPECT_THROW(run_motion(options), InvalidInput);
  options = quick();
  options.heart.phases = 10;  // 75 % is not among them
  EXPECT_THROW(run_motion(options), InvalidInput);
  options = quick();
  options.depths = {0, 2};
  EXPECT_THROW(run_motion(options), InvalidInput);
  options = quick();
  options.depths = {2, 5};
  options.depth = 5;
  options.methods = {MotionMethod::tps_kc};
  EXPECT_THROW(run_motion(options), InvalidInput);
  options = quick();
  options.compared_phases = {0.15};  // not among the four
  EXPECT_THROW(run_motion(options), InvalidInput);
  EXPECT_THROW(motion_method_of("magic"), InvalidInput);
  EXPECT_EQ(motion_method_of("grbf-kc"), MotionMethod::grbf_kc);
}

TEST(MotionExperiment, StopsWhenCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(run_motion(quick(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
