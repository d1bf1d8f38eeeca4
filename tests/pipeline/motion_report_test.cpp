#include "ostia/pipeline/motion_report.h"

#include "moving_shapes.h"
#include "shared_data.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <nlohmann/json.hpp>

#include <sstream>

namespace ostia::pipeline {
namespace {

namespace fs = std::filesystem;
using analysis::TreeMotion;
using analysis::testing::HeartBeat;
using nlohmann::json;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using M = analysis::MotionMeasure;

/// A fork of straight arms (no torsion) whose wall turns.
const TreeMotion& beating_fork() {
  static const TreeMotion motion = [] {
    const geometry::VesselTree rest = analysis::testing::fork(1.0);
    const motion::MovingCage cage(
        analysis::testing::cage_of(rest, HeartBeat{}, analysis::testing::heart_box, 3));
    return analysis::measure_motion(analysis::carried_tree(rest, cage, analysis::even_phases(10)));
  }();
  return motion;
}

const JobKey key{"motion measure", {{"motion", "00"}}, "{}"};

TEST(MotionReport, JsonHoldsWhatWasMeasuredAndNullForWhatWasNot) {
  const json all = json::parse(motion_measures_json(beating_fork()));
  EXPECT_EQ(all["percents"].size(), 10U);
  ASSERT_EQ(all["branches"].size(), 2U);
  const json& main = all["branches"][0]["measures"];
  EXPECT_EQ(main.size(), analysis::branch_measure_count);
  for (std::size_t k = 0; k < 10; ++k)
    EXPECT_EQ(main["stretch"]["values"][k].get<double>(), beating_fork().branches[0][M::stretch].values[k]);
  EXPECT_EQ(main["twist"]["unit"], "deg");
  EXPECT_TRUE(all["branches"][1]["measures"]["torsion_mean"]["at_template"].is_null());
  EXPECT_EQ(all["angles"].size(), 3U);
  EXPECT_EQ(all["angles"][2]["name"], "main distal | side");
  EXPECT_EQ(all["distances"][0]["first"], "main");
  EXPECT_FALSE(all["rests"].empty());
}

std::vector<std::vector<std::string>> rows_of(const std::string& csv) {
  std::vector<std::vector<std::string>> rows(1);
  std::string_view rest = csv;
  while (!rest.empty()) {
    const core::CsvCell cell = core::take_csv_cell(rest);
    rows.back().push_back(cell.text);
    if (cell.last && !rest.empty()) rows.emplace_back();
  }
  return rows;
}

TEST(MotionReport, TheLongTableHasARowForEachBranchMeasureAndTime) {
  const auto rows = rows_of(motion_measures_csv(beating_fork()));
  EXPECT_THAT(rows[0], ElementsAre("branch", "percent", "time_s", "measure", "value", "unit", "at_template"));
  EXPECT_EQ(rows.size(), 1 + 10 * (2 * analysis::branch_measure_count + 3 + 3));
  double stretch = 0.0;
  for (const auto& row : rows) {
    ASSERT_EQ(row.size(), 7U);
    if (row[0] == "side" && row[1] == "50" && row[3] == "stretch") {
      EXPECT_EQ(row[2], "0.4");
      stretch = std::stod(row[4]);
    }
  }
  EXPECT_NEAR(stretch, beating_fork().branches[1][M::stretch].values[5], 1e-6);
  EXPECT_THAT(rows,
              Contains(ElementsAre("main | side", "0", "0", "distance", ::testing::_, "mm", ::testing::_)));
}

TEST(MotionReport, TheTableAlongBranchesHasTheTemplateAndAllTimes) {
  const auto rows = rows_of(motion_along_csv(beating_fork()));
  EXPECT_THAT(rows[0], ElementsAre("branch", "percent", "s_mm", "displacement (mm)", "speed (mm/s)",
                                   "stretch", "curvature (1/mm)", "torsion (1/mm)", "twist (deg)"));
  std::size_t points = 0;
  for (const auto& branch : beating_fork().branches) points += branch.s_mm.size();
  EXPECT_EQ(rows.size(), 1 + 11 * points);
  EXPECT_EQ(rows[1][1], "template");
  EXPECT_EQ(rows[1][4], "");  // a place has no speed
  EXPECT_NEAR(std::stod(rows[2][5]), 1.0, 1e-9);
}

TEST(MotionReport, EachMeasureHasAPictureUnlessNothingIsKnown) {
  std::vector<std::string> names;
  for (const ReportPicture& one : motion_pictures(beating_fork())) names.push_back(one.name);
  for (const char* name :
       {"displacement_mean", "speed_mean", "stretch", "curvature_mean", "twist", "distance", "angle"})
    EXPECT_THAT(names, Contains(name));
  // Lines that do not bend: no plot without a curve.
  const auto still = [](const geometry::Vec3& p, double) { return p; };
  const TreeMotion line = analysis::measure_motion(analysis::testing::followed(
      analysis::testing::apart({analysis::testing::straight({0, 0, 0}, {0, 0, 30})}), still));
  for (const ReportPicture& one : motion_pictures(line)) {
    EXPECT_NE(one.name, "torsion_mean");
    EXPECT_NE(one.name, "distance");
    EXPECT_GT(one.picture.width(), 0);
  }
}

TEST(MotionReport, TheFolderIsWholeAndTheSameEachTime) {
  const fs::path folder = ostia::testing::temporary_folder("motion-report");
  write_motion_report(folder / "a", beating_fork(), key, 0.0);
  write_motion_report(folder / "b", beating_fork(), key, 0.0);
  for (const char* name : {"measures.json", "measures.csv", "along.csv", "report.html",
                           "pictures/stretch.png", "pictures/stretch.svg", "pictures/angle.svg"})
    EXPECT_EQ(core::read_file(folder / "a" / name), core::read_file(folder / "b" / name)) << name;
  EXPECT_TRUE(already_done(folder / "a", key).has_value());
  const std::string html = core::read_file(folder / "a" / "report.html");
  EXPECT_THAT(html, HasSubstr("Branches over the cycle"));
  EXPECT_THAT(html, HasSubstr("main"));
}

TEST(MotionReport, NothingIsLeftWhenCancelled) {
  const fs::path folder = ostia::testing::temporary_folder("motion-report");
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(write_motion_report(folder / "a", beating_fork(), key, 0.0, task), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder));
}

}  // namespace
}  // namespace ostia::pipeline
