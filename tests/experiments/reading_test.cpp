#include "ostia/experiments/reading.h"

#include "experiment_schema.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/lumen/edit.h"
#include "ostia/lumen/start_surface.h"
#include "ostia/phantom/vessel_field.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <string>

namespace ostia::experiments {
namespace {

using geometry::Vec3;
using ::testing::Contains;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr double trunk_mm = 1.6, branch_mm = 1.1;
constexpr double fork_mm = 25.0;

/// Straight and round.
phantom::CoronaryVessel tube(const std::string& name, const Vec3& from, const Vec3& direction,
                             double length_mm, double radius_mm) {
  phantom::CoronaryVessel made;
  made.name = name;
  const int steps = static_cast<int>(std::lround(length_mm / 0.1));
  for (int i = 0; i <= steps; ++i) {
    made.axis.points.push_back(from + 0.1 * i * direction.normalized());
    made.axis.radius.push_back(radius_mm);
    made.healthy_radius_mm.push_back(radius_mm);
  }
  geometry::complete(made.axis);
  const auto rows = static_cast<std::size_t>(length_mm / 0.5) + 1;
  made.lumen = phantom::RadialProfile(0.5, 16, std::vector<double>(16 * rows, radius_mm));
  made.wall = phantom::RadialProfile(0.5, 16, std::vector<double>(16 * rows, radius_mm + 0.4));
  return made;
}

phantom::CoronaryTree trunk_alone() {
  phantom::CoronaryTree tree;
  tree.vessels.push_back(tube("LAD", Vec3::Zero(), Vec3::UnitZ(), 70.0, trunk_mm));
  return tree;
}

phantom::CoronaryTree forked() {
  phantom::CoronaryTree tree = trunk_alone();
  phantom::CoronaryVessel branch = tube("D1", Vec3(0.0, 0.0, fork_mm), Vec3(1.0, 0.0, 1.0), 40.0, branch_mm);
  branch.id = 1;
  branch.parent = 0;
  branch.parent_s_mm = fork_mm;
  branch.s_free_mm = 5.0;
  tree.vessels.push_back(std::move(branch));
  return tree;
}

/// Contrast in the lumina, with the scanner's blur.
imaging::ImageVolume image_of(const phantom::CoronaryTree& tree, double lumen_hu = 400.0) {
  const phantom::VesselField field(tree);
  imaging::ImageVolume image;
  image.geometry.spacing = {0.5, 0.5, 0.5};
  image.geometry.origin = {-8.0, -8.0, -6.0};
  image.geometry.size = {96, 32, 168};
  image.voxels.resize(
      static_cast<std::size_t>(image.geometry.size[0] * image.geometry.size[1] * image.geometry.size[2]));
  core::parallel_for(168, 1, [&](std::size_t k) {
    for (std::size_t j = 0; j < 32; ++j)
      for (std::size_t i = 0; i < 96; ++i) {
        const Vec3 place = image.geometry.origin +
                           0.5 * Vec3(static_cast<double>(i), static_cast<double>(j), static_cast<double>(k));
        const double outside = field.value(phantom::Boundary::lumen, place, 3.0);
        const double share = 0.5 * std::erfc(outside / (0.3 * std::sqrt(2.0)));
        image.voxels[(k * 32 + j) * 96 + i] = static_cast<std::int16_t>(std::lround(lumen_hu * share));
      }
  });
  return image;
}

/// The truth itself, moved.
lumen::LumenModel model_of(const phantom::CoronaryTree& truth, const Vec3& shift = Vec3::Zero()) {
  geometry::VesselTree tree = phantom::vessel_tree(truth);
  for (geometry::TreeNode& node : tree.nodes) node.position += shift;
  for (geometry::TreeSegment& segment : tree.segments)
    for (Vec3& point : segment.axis.points) point += shift;
  std::vector<lumen::RadialWall> walls;
  for (const geometry::Vessel& vessel : tree.vessels)
    walls.emplace_back(
        [radius = vessel.name == "LAD" ? trunk_mm : branch_mm](double, double) { return radius; });
  return lumen::model_of_walls(tree, walls);
}

std::int32_t id_of(const lumen::LumenModel& model, const std::string& name) {
  for (const geometry::Vessel& vessel : model.tree.vessels)
    if (vessel.name == name) return vessel.id;
  ADD_FAILURE() << name;
  return -1;
}

ReadingRun read(const phantom::CoronaryTree& truth, const imaging::ImageVolume& image,
                const lumen::LumenModel& start, const ReadingOptions& options = {}) {
  return read_tree(truth, image, std::make_shared<const lumen::LumenModel>(start), options);
}

const phantom::CoronaryTree& truth() {
  static const phantom::CoronaryTree tree = forked();
  return tree;
}
const imaging::ImageVolume& image() {
  static const imaging::ImageVolume made = image_of(truth());
  return made;
}

TEST(Reading, NothingIsDoneWhereAllIsRight) {
  const ReadingRun run = read(truth(), image(), model_of(truth()));
  EXPECT_EQ(run.vessels, 2U);
  EXPECT_TRUE(run.actions.empty());
  EXPECT_EQ(run.before.beyond_mm, 0.0);
  EXPECT_EQ(run.before.wrong_names, 0);
  // The trunk from 2 mm to 2 mm before its end, the branch from 5 mm on.
  EXPECT_NEAR(run.before.length_mm, 66.5 + 33.5, 1e-9);
  EXPECT_GT(run.seconds(), 0.0);  // of looking
  EXPECT_THAT(run.left, IsEmpty());
}

TEST(Reading, AMissingBranchCostsItsClickAndItsName) {
  const lumen::LumenModel whole = model_of(truth());
  const ReadingRun run =
      read(truth(), image(), lumen::apply(whole, lumen::BranchDelete{id_of(whole, "D1")}).model);
  EXPECT_EQ(run.before.missing_mm, 33.5);
  EXPECT_EQ(run.count(ReadingAct::addition), 1U);
  EXPECT_EQ(run.clicks(), 1);
  EXPECT_LE(run.count(ReadingAct::naming), 1U);
  EXPECT_EQ(run.actions.size(), 1 + run.count(ReadingAct::naming));
  EXPECT_EQ(run.after.beyond_mm, 0.0);
  EXPECT_EQ(run.after.wrong_names, 0);
}

TEST(Reading, AWrongNameCostsOneActionAndSwappedOnesThree) {
  const lumen::LumenModel whole = model_of(truth());
  const auto renamed = [](const lumen::LumenModel& model, std::int32_t id, const char* name) {
    return lumen::apply(model, lumen::VesselRename{id, name}).model;
  };
  const lumen::LumenModel wrong = renamed(whole, id_of(whole, "D1"), "OM1");
  const ReadingRun run = read(truth(), image(), wrong);
  ASSERT_EQ(run.actions.size(), 1U);
  EXPECT_EQ(run.actions[0].act, ReadingAct::naming);
  EXPECT_EQ(run.before.wrong_names, 1);
  EXPECT_EQ(run.after.wrong_names, 0);
  // Think, point, press, to the keyboard, F2, two letters, Return.
  EXPECT_NEAR(run.actions[0].seconds, 1.35 + 1.1 + 0.1 + 0.4 + 4 * 0.28, 1e-9);

  const lumen::LumenModel swapped =
      renamed(renamed(wrong, id_of(whole, "LAD"), "D1"), id_of(whole, "D1"), "LAD");
  const ReadingRun both = read(truth(), image(), swapped);
  EXPECT_EQ(both.actions.size(), 3U);
  EXPECT_EQ(both.after.wrong_names, 0);
}

TEST(Reading, AVesselThatFollowsNoArteryGoesAndALostEndComesBack) {
  const lumen::LumenModel whole = model_of(truth());
  lumen::BranchAdd astray{id_of(whole, "LAD"), "V9", {}, {}, {}};
  for (int i = 0; i <= 40; ++i) {
    astray.points.push_back(Vec3(-0.5 * i, 0.0, 40.0 + 0.5 * i));
    astray.radius_mm.push_back(1.0);
  }
  const ReadingRun run = read(truth(), image(), lumen::apply(whole, astray).model);
  ASSERT_EQ(run.actions.size(), 1U);
  EXPECT_EQ(run.actions[0].act, ReadingAct::removal);
  EXPECT_GT(run.before.astray_mm, 15.0);
  EXPECT_EQ(run.after.astray_mm, 0.0);

  const ReadingRun shorter =
      read(truth(), image(), lumen::apply(whole, lumen::AxisTrim{id_of(whole, "LAD"), 50.0}).model);
  EXPECT_EQ(shorter.count(ReadingAct::ending), 1U);
  EXPECT_EQ(shorter.actions.size() - shorter.count(ReadingAct::stroke), 1U);
  EXPECT_GT(shorter.before.missing_mm, 17.0);
  EXPECT_EQ(shorter.after.missing_mm, 0.0);
}

TEST(Reading, ATubeOneMillimetreOffGetsWithinTheTolerance) {
  const phantom::CoronaryTree alone = trunk_alone();
  const ReadingRun run = read(alone, image_of(alone), model_of(alone, {0.0, 1.0, 0.0}));
  EXPECT_NEAR(run.before.worst_axis_mm, 1.0, 0.01);
  EXPECT_NEAR(run.before.worst_wall_mm, 1.0, 0.05);
  EXPECT_EQ(run.before.share_beyond(), 1.0);
  EXPECT_GE(run.count(ReadingAct::axis), 1U);
  EXPECT_LE(run.after.worst_axis_mm, 0.3);
  EXPECT_LE(run.after.share_beyond(), 0.03);  // what lies between the views
  EXPECT_LE(run.after.worst_wall_mm, 0.4);
  EXPECT_FALSE(run.gave_up);
}

TEST(Reading, WithoutATreeEachVesselIsClicked) {
  const ReadingRun run = read_tree(truth(), image(), nullptr);
  EXPECT_FALSE(run.automatic);
  EXPECT_EQ(run.before.share_beyond(), 1.0);
  EXPECT_EQ(run.count(ReadingAct::addition), 2U);
  EXPECT_EQ(run.clicks(), 3);  // both ends of the first, the end of the branch
  EXPECT_EQ(run.count(ReadingAct::naming), 2U);
  EXPECT_EQ(run.after.missing_mm, 0.0);
  EXPECT_LE(run.after.share_beyond(), 0.05);
}

TEST(Reading, WhatTheProgramRefusesCountsAndIsLeft) {
  const lumen::LumenModel whole = model_of(truth());
  imaging::ImageVolume empty = image();
  std::fill(empty.voxels.begin(), empty.voxels.end(), std::int16_t{0});
  const ReadingRun run =
      read(truth(), empty, lumen::apply(whole, lumen::BranchDelete{id_of(whole, "D1")}).model);
  EXPECT_EQ(run.count(ReadingAct::addition), 3U);
  EXPECT_EQ(run.refused(), 3U);
  EXPECT_THAT(run.left, Contains(HasSubstr("D1 is missing")));
  EXPECT_EQ(run.after.missing_mm, 33.5);
}

TEST(Reading, GivesUpAtTheMostActions) {
  const lumen::LumenModel whole = model_of(truth());
  ReadingOptions options;
  options.most_actions = 1;
  const ReadingRun run =
      read(truth(), image(), lumen::apply(whole, lumen::AxisTrim{id_of(whole, "LAD"), 50.0}).model, options);
  EXPECT_EQ(run.actions.size(), 1U);
  EXPECT_TRUE(run.gave_up);
}

TEST(Reading, IsTheSameForAnyNumberOfThreads) {
  const phantom::CoronaryTree alone = trunk_alone();
  const imaging::ImageVolume shown = image_of(alone);
  const lumen::LumenModel start = model_of(alone, {0.0, 0.6, 0.0});
  core::set_max_threads(1);
  const ReadingRun one = read(alone, shown, start);
  core::set_max_threads(4);
  const ReadingRun four = read(alone, shown, start);
  core::set_max_threads(0);
  EXPECT_EQ(one.digest, four.digest);
  EXPECT_EQ(one.actions.size(), four.actions.size());
  EXPECT_EQ(one.after.beyond_mm, four.after.beyond_mm);
  EXPECT_EQ(one.after.worst_wall_mm, four.after.worst_wall_mm);
  ReadingOptions other;
  other.seed = 2;
  EXPECT_NE(read(alone, shown, start, other).digest, one.digest);
}

TEST(Reading, TablesHoldBothStarts) {
  const ReadingQuartiles quartiles = quartiles_of({4.0, 1.0, 2.0, 3.0, 5.0});
  EXPECT_EQ(quartiles.low, 2.0);
  EXPECT_EQ(quartiles.median, 3.0);
  EXPECT_EQ(quartiles.high, 4.0);
  EXPECT_TRUE(std::isnan(quartiles_of({}).median));

  ReadingRun run;
  run.patient = "seed 1";
  run.automatic = true;
  run.before.length_mm = run.after.length_mm = 90.0;
  run.vessels = 3;
  run.actions = {{ReadingAct::search, {}, 0, 2.0, {}}, {ReadingAct::stroke, "LAD", 0, 4.0, "no"}};
  ReadingRun manual = run;
  manual.automatic = false;
  manual.actions.resize(1);
  const ReadingSummary summary = summarize({run, manual}, true);
  EXPECT_EQ(summary.patients, 1U);
  EXPECT_EQ(summary.actions.median, 2.0);
  EXPECT_EQ(summary.tree_actions.median, 1.0);
  const auto folder = ostia::testing::temporary_folder("reading");
  write_reading_report(folder, {run, manual}, {});
  for (const char* name : {"patients.csv", "actions.csv", "report.html"})
    EXPECT_TRUE(std::filesystem::exists(folder / name)) << name;
  EXPECT_TRUE(fits_schema(reading_json({run, manual}, {}), "reading"));
  EXPECT_THAT(reading_text({run, manual}), HasSubstr("automatic start"));
}

TEST(Reading, RefusesWhatMakesNoSense) {
  ReadingPatients patients;
  patients.patients = 0;
  EXPECT_THROW(read_patients(patients), InvalidInput);
  patients = {};
  patients.reader.tolerance_mm = 0.0;
  EXPECT_THROW(read_patients(patients), InvalidInput);
  ReadingOptions options;
  options.least_diameter_mm = 4.0;  // nothing is so wide
  EXPECT_THROW(read_tree(truth(), image(), nullptr, options), InvalidInput);
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(read_tree(truth(), image(), nullptr, {}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::experiments
