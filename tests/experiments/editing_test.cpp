#include "ostia/experiments/editing.h"

#include "ostia/core/error.h"
#include "ostia/io/centerline_file.h"
#include "ostia/io/contour_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>
#include <numbers>

namespace ostia::experiments {
namespace {

using std::numbers::pi;
constexpr double length_mm = 30.0;

/// A straight vessel whose lumen is oval and narrows in the middle.
double wall(double s, double theta) {
  const double narrow = 1.0 - 0.4 * std::exp(-std::pow((s - 15.0) / 4.0, 2));
  return 1.5 * narrow * (1.0 + 0.08 * std::cos(2.0 * theta + 0.6));
}

geometry::VesselTree tree() {
  geometry::Centerline axis;
  for (int i = 0; i <= 60; ++i) {
    axis.points.push_back({0.0, 0.0, 0.5 * i});
    axis.radius.push_back(1.5);
  }
  geometry::complete(axis);
  geometry::VesselTree out;
  out.nodes = {{1, axis.points.front()}, {2, axis.points.back()}};
  out.segments = {{3, 1, 2, axis}};
  out.vessels = {{4, "LAD", {3}}};
  return out;
}

geometry::ContourSection section(const std::string& observer, double wider_mm) {
  geometry::ContourSection out;
  out.section = "s01";
  out.vessel = "LAD";
  out.observer = observer;
  out.health = geometry::Health::diseased;
  const geometry::AxisCurve axis(tree().segments[0].axis);
  for (double s = 5.0; s <= length_mm - 5.0; s += 1.0) {
    geometry::Contour contour;
    contour.s_mm = s;
    for (int i = 0; i < 64; ++i) {
      const double theta = 2.0 * pi * i / 64;
      contour.points.push_back(axis.place(s, theta, wall(s, theta) + wider_mm));
    }
    out.contours.push_back(contour);
  }
  return out;
}

geometry::ContourSet contours() {
  return {{section("truth", 0.0), section("observer1", 0.05)}};
}

TEST(Editing, BringsATubeToTheObserversContours) {
  const SectionRun run = edit_section(tree(), contours(), "s01");
  EXPECT_EQ(run.health, geometry::Health::diseased);
  EXPECT_NEAR(run.length_mm, 20.0, 0.1);
  EXPECT_GT(run.first().to_observer.msd_mm, 0.45);
  EXPECT_LT(run.last().to_observer.msd_mm, 0.09);
  EXPECT_LT(run.last().to_observer.max_sd_mm, 0.5);
  EXPECT_LE(run.edits.size(), 15U);
  EXPECT_LE(run.section_strokes, 0.3 * static_cast<double>(run.edits.size()) + 1e-9);
  EXPECT_EQ(run.steps.size(), run.edits.size() + 1);
  EXPECT_NEAR(run.observer_against_truth.msd_mm, 0.05, 0.005);
  EXPECT_LT(run.floor_mm, 0.02);
  EXPECT_FALSE(run.stopped.empty());
}

TEST(Editing, ItsEditsAppliedAgainGiveTheSameModel) {
  EditingOptions options;
  options.reader.most_strokes = 4;
  const SectionRun run = edit_section(tree(), contours(), "s01", options);
  lumen::LumenModel model = run.start;
  for (const lumen::Edit& edit : run.edits) model = lumen::apply(model, edit).model;
  EXPECT_EQ(lumen::digest(model), run.digest);
  EXPECT_EQ(edit_section(tree(), contours(), "s01", options).digest, run.digest);
}

TEST(Editing, RefusesWhatIsNotThere) {
  EXPECT_THROW(edit_section(tree(), contours(), "s99"), InvalidInput);
  EditingOptions options;
  options.observer = "nobody";
  EXPECT_THROW(edit_section(tree(), contours(), "s01", options), InvalidInput);
  geometry::ContourSet elsewhere = contours();
  for (auto& one : elsewhere.sections) one.vessel = "RCA";
  EXPECT_THROW(edit_section(tree(), elsewhere, "s01"), InvalidInput);
}

TEST(Editing, CancelsWithinAStroke) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(edit_section(tree(), contours(), "s01", {}, task), Cancelled);
}

TEST(Editing, ReadsASuite) {
  const auto folder = std::filesystem::temp_directory_path() / "ostia-editing-test";
  std::filesystem::remove_all(folder);
  std::filesystem::create_directories(folder / "dataset00");
  io::write_centerlines(folder / "dataset00" / "centerlines.vtp", tree());
  io::write_contours(folder / "dataset00" / "contours.json", contours());
  EditingOptions options;
  options.reader.most_strokes = 3;
  const std::vector<SectionRun> runs = edit_suite(folder, options);
  ASSERT_EQ(runs.size(), 1U);
  EXPECT_EQ(runs[0].case_name, "dataset00");
  const EditingSummary summary = summarize(runs, geometry::Health::diseased);
  EXPECT_EQ(summary.sections, 1U);
  EXPECT_EQ(summary.median_strokes, 3.0);
  EXPECT_LT(summary.final.msd_mm, summary.start.msd_mm);
  EXPECT_EQ(summarize(runs, geometry::Health::healthy).sections, 0U);
  std::filesystem::remove_all(folder);
  try {
    edit_suite(folder, options);
    FAIL();
  } catch (const InvalidInput& error) {
    EXPECT_THAT(error.what(), ::testing::HasSubstr("ostia phantom"));
  }
}

}  // namespace
}  // namespace ostia::experiments
