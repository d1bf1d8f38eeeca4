// Minutes: cases of the suites drawn, scanned and searched.

#include "shared_data.h"

#include "ostia/core/files.h"
#include "ostia/experiments/hard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace ostia::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

HardOptions one_coarse_case() {
  HardOptions options;
  options.cases = 1;
  options.voxel_mm = 2.0;
  options.search = false;
  return options;
}

TEST(HardExperimentLong, RunsTheTwoMethodsOnBothSuitesAndGivesTheSameAgain) {
  HardOptions options = one_coarse_case();
  options.easy = true;
  const std::vector<HardRun> runs = run_hard(options);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].suite, HardSuite::full);
  EXPECT_EQ(runs[1].suite, HardSuite::hard);
  const std::vector<HardRow> rows = rows_of(runs, options.scores);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_GT(rows[0].summary.annotated.ov, 0.6) << "between true ends on the easy suite";
  EXPECT_GT(rows[0].summary.annotated.ov, rows[1].summary.annotated.ov);
  for (const HardRow& row : rows) {
    EXPECT_EQ(row.cases, 1U);
    EXPECT_EQ(row.summary.annotated.vessels, 4U);
    EXPECT_FALSE(row.patients);
  }
  const auto json = nlohmann::json::parse(hard_json(runs, options));
  EXPECT_FALSE(json["cases"][0].contains("search"));
  EXPECT_TRUE(json["cases"][0]["drawn"].empty());
  options.easy = false;
  const std::vector<HardRun> again = run_hard(options);
  EXPECT_EQ(nlohmann::json::parse(hard_json(again, options))["cases"][0], json["cases"][1]);
}

TEST(HardExperimentLong, ScoresTheSearchAndLeavesItsTables) {
  HardOptions options = one_coarse_case();
  options.voxel_mm = 1.5;
  options.search = true;
  const std::vector<HardRun> runs = run_hard(options);
  ASSERT_EQ(runs.size(), 1U);
  const std::vector<HardRow> rows = rows_of(runs, options.scores);
  ASSERT_EQ(rows.size(), 3U);
  for (const HardMethod method : {HardMethod::path, HardMethod::growing})
    EXPECT_EQ(run_of(runs[0], method).vessels.size(), runs[0].search.vessels.size()) << word(method);
  const auto json = nlohmann::json::parse(hard_json(runs, options));
  EXPECT_EQ(json["kind"], "hard");
  EXPECT_EQ(json["rows"].size(), 3U);
  EXPECT_DOUBLE_EQ(json["rows"][2]["annotated"]["ov"], rows[2].summary.annotated.ov);
  EXPECT_DOUBLE_EQ(json["cases"][0]["drawn"]["noise"], runs[0].draw.noise_hu);
  const fs::path folder = testing::temporary_folder("hard");
  write_hard_report(folder, runs, options);
  EXPECT_TRUE(fs::exists(folder / "report.html"));
  const std::string cases = core::read_file(folder / "cases.csv");
  EXPECT_EQ(std::ranges::count(cases, '\n'), 2);
  EXPECT_THAT(core::read_file(folder / "vessels.csv"), HasSubstr("hard,drawn,1,path,LAD,yes"));
  EXPECT_THAT(hard_text(runs, options), HasSubstr("hard | drawn | growing | 1"));
}

}  // namespace
}  // namespace ostia::experiments
