#include "ostia/experiments/motion.h"

#include "motion/motion_branches.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/parallel.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/phantom/heartbeat.h"
#include "ostia/phantom/phantom_case.h"

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <filesystem>

namespace ostia::experiments {
namespace {

using geometry::Vec3;

BeatingHeartOptions motion_coarse() {
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
  options.heart = motion_coarse();
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
  const BeatingHeart heart = beating_heart(motion_coarse());
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

/// Whole at all phases, its wall where it is.
const BeatingHeart& without_noise() {
  static const BeatingHeart heart = [] {
    BeatingHeartOptions options = motion_coarse();
    options.noise_mm = 0.0;
    return beating_heart(options);
  }();
  return heart;
}

TEST(BeatingHeart, TheNoiseIsAsAskedFor) {
  BeatingHeartOptions options = motion_coarse();
  options.noise_mm = 0.2;
  const BeatingHeart noisy = beating_heart(options);
  const BeatingHeart& smooth = without_noise();
  double squares = 0.0;
  const auto& a = noisy.phases[1].segmented.points;
  const auto& b = smooth.phases[1].segmented.points;
  ASSERT_EQ(a.size(), b.size());
  for (std::size_t i = 0; i < a.size(); ++i) squares += (a[i] - b[i]).squaredNorm();
  EXPECT_NEAR(std::sqrt(squares / static_cast<double>(a.size())), 0.2, 0.04);
}

TEST(BeatingHeart, PhasesWithLossLackTheBranchThatIsNamed) {
  BeatingHeartOptions options = motion_coarse();
  options.noise_mm = 0.0;
  const BeatingHeart& whole = without_noise();
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
  const std::vector<MotionRun> runs = run_motion(options).runs;
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
  options.depths = {1};
  options.depth = 1;
  options.dice_resolution_mm = 0.8;
  options.methods.clear();
  core::set_max_threads(1);
  const auto once = run_motion(options).runs;
  core::set_max_threads(0);
  const auto again = run_motion(options).runs;
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
  const MotionResults results{{before, after}, {}};
  const auto json = nlohmann::json::parse(motion_json(results, options));
  ASSERT_EQ(json.at("rows").size(), 2U);
  EXPECT_EQ(json.at("rows")[1].at("dice"), 0.95);
  EXPECT_NE(motion_text(results).find("before registration"), std::string::npos);
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

/// A folder of the test's own, gone with it.
class Folder {
 public:
  explicit Folder(const std::string& name)
      : path_(std::filesystem::temp_directory_path() / ("ostia-motion-" + name)) {
    std::filesystem::remove_all(path_);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  ~Folder() { std::filesystem::remove_all(path_); }
  const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

MotionOptions kept(const std::filesystem::path& folder) {
  MotionOptions options = quick();
  options.depths = {1};
  options.depth = 1;
  options.methods = {MotionMethod::cage_rest};
  options.dice_resolution_mm = 0.8;
  options.keep = folder;
  return options;
}

TEST(MotionExperiment, GoesOnWhereItWasStopped) {
  const Folder folder("keep");
  const MotionOptions options = kept(folder.path());
  const MotionResults once = run_motion(options);
  ASSERT_FALSE(once.branches.empty());
  // Nothing is run again: the seconds are those that were kept.
  const MotionResults again = run_motion(options);
  ASSERT_EQ(again.runs.size(), once.runs.size());
  ASSERT_EQ(again.branches.size(), once.branches.size());
  for (std::size_t i = 0; i < once.runs.size(); ++i) {
    EXPECT_NEAR(again.runs[i].seconds, once.runs[i].seconds, 1e-6);
    EXPECT_EQ(word(again.runs[i].method), word(once.runs[i].method));
  }
  // As if it had been stopped in the middle of a line, two lines from the end.
  const std::filesystem::path table = folder.path() / "runs.csv";
  std::string text = core::read_file(table);
  for (int lines = 0; lines < 2; ++lines) text.resize(text.rfind('\n', text.size() - 2) + 1);
  core::write_file(table, text + "heart 1,75,ca");
  const MotionResults mended = run_motion(options);
  ASSERT_EQ(mended.runs.size(), once.runs.size());
  for (const MotionRun& run : once.runs)
    EXPECT_TRUE(std::any_of(mended.runs.begin(), mended.runs.end(),
                            [&](const MotionRun& other) {
                              return other.method == run.method && other.sampling == run.sampling &&
                                     std::abs(other.phase - run.phase) < 1e-9 &&
                                     std::abs(other.dice - run.dice) < 1e-6;
                            }))
        << word(run.method) << run.phase;
}

TEST(MotionExperiment, BranchesOfTwoDepthsAreKeptApart) {
  const Folder folder("keep_depths");
  MotionOptions options = kept(folder.path());
  options.methods.clear();
  const MotionResults first = run_motion(options);
  MotionOptions other = options;
  other.depth = options.depth + 1;
  other.depths = {other.depth};
  const MotionResults finer = run_motion(other);
  const MotionResults again = run_motion(options);
  ASSERT_EQ(again.branches.size(), first.branches.size());
  ASSERT_EQ(finer.branches.size(), first.branches.size());
  double difference = 0.0;
  for (std::size_t i = 0; i < first.branches.size(); ++i) {
    EXPECT_EQ(again.branches[i].depth, options.depth);
    EXPECT_EQ(finer.branches[i].depth, other.depth);
    EXPECT_NEAR(again.branches[i].stretch, first.branches[i].stretch, 1e-7);
    difference = std::max(difference, std::abs(finer.branches[i].stretch - first.branches[i].stretch));
  }
  EXPECT_GT(difference, 1e-6);
}

TEST(MotionExperiment, KeptRunsOfOtherHeartsAreRefused) {
  const Folder folder("other");
  std::filesystem::create_directories(folder.path());
  MotionOptions options = kept(folder.path());
  core::write_file(folder.path() / "hearts.json", "{}\n");
  EXPECT_THROW(run_motion(options), InvalidInput);
  std::filesystem::remove(folder.path() / "hearts.json");
  core::write_file(folder.path() / "runs.csv", "a,b\n1,2\n");
  EXPECT_THROW(run_motion(options), InvalidInput);
}

TEST(MotionExperiment, MethodsAreComparedWhereEachWasRun) {
  std::vector<MotionRun> runs;
  const auto add = [&](MotionMethod method, double phase, double dice) {
    MotionRun run;
    run.heart = "heart 1";
    run.sampling = "all";
    run.method = method;
    run.phase = phase;
    run.depth = 4;
    run.dice = dice;
    runs.push_back(run);
  };
  add(MotionMethod::tps_l2, 0.15, 0.8);
  add(MotionMethod::cage, 0.15, 0.9);
  add(MotionMethod::cage, 0.35, 0.5);
  add(MotionMethod::descent, 0.15, 0.7);
  add(MotionMethod::descent, 0.35, 0.1);  // thin-plate splines were not run here
  const std::vector<MotionRow> rows = rows_of(runs, true);
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0].method, MotionMethod::cage);
  EXPECT_EQ(rows[1].method, MotionMethod::descent);
  EXPECT_EQ(rows[2].method, MotionMethod::tps_l2);
  for (const MotionRow& row : rows) EXPECT_EQ(row.runs, 1U);
  EXPECT_NEAR(rows[1].dice, 0.7, 1e-12);
}

TEST(BranchRuns, ACageThatGoesWithTheHeartHasItsStretchAndTorsion) {
  BeatingHeartOptions options = motion_coarse();
  options.phases = 8;
  const BeatingHeart heart = beating_heart(options);
  const geometry::CageGrid grid = geometry::cage_around(heart.model.points, 4);
  const std::vector<Vec3> rest = geometry::rest_points(grid);
  phantom::CaseOptions patient;
  patient.seed = options.seed;
  const phantom::Heartbeat beat = phantom::draw_heartbeat(phantom::plan_case(patient).heart, options.seed);
  std::vector<std::vector<Vec3>> places;
  for (const HeartPhaseModel& phase : heart.phases)
    places.push_back(phantom::moved(rest, beat.phase(100.0 * phase.phase)));
  const std::vector<BranchRun> branches = branch_runs(heart, grid, places, {});
  ASSERT_GE(branches.size(), 8U * 4U);
  const BranchAgreements near = agreement(branches);
  EXPECT_LT(near.stretch.worst, 0.02);
  EXPECT_LT(near.torsion.median, 0.05);
  EXPECT_LT(near.torsion_size.median, 0.02);
  EXPECT_GT(near.torsion_size.within_5_percent, 0.9);
  double shortest = 1.0;
  for (const BranchRun& run : branches) shortest = std::min(shortest, run.true_stretch);
  EXPECT_LT(shortest, 0.97);
}

TEST(BranchRuns, AgreementIsReckonedByHand) {
  const auto run = [](double phase, double fitted, double truth) {
    BranchRun one;
    one.heart = "heart 1";
    one.branch = "LAD";
    one.phase = phase;
    one.stretch = fitted;
    one.true_stretch = truth;
    one.torsion = one.true_torsion = one.true_size = std::nan("");
    one.curvature = one.true_curvature = 0.1;
    return one;
  };
  const BranchAgreements near = agreement({run(0.0, 1.0, 1.0), run(0.5, 0.99, 0.9), run(0.7, 0.99, 1.0)});
  EXPECT_EQ(near.stretch.count, 3U);
  EXPECT_NEAR(near.stretch.worst, 0.1, 1e-9);
  EXPECT_NEAR(near.stretch.median, 0.01, 1e-9);
  EXPECT_NEAR(near.stretch.within_5_percent, 2.0 / 3.0, 1e-9);
  EXPECT_NEAR(near.stretch.of_change, (0.09 + 0.01) / 0.1 / 3.0, 1e-9);
  EXPECT_EQ(near.torsion.count, 0U);
  EXPECT_EQ(near.torsion_size.count, 0U);
  EXPECT_EQ(near.curvature.worst, 0.0);
}

TEST(MotionExperiment, StopsWhenCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(run_motion(quick(), task), Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
