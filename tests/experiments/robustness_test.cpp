#include "ostia/experiments/robustness.h"

#include "shared_data.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <set>

namespace ostia::experiments {
namespace {

using ::testing::Contains;
using ::testing::HasSubstr;

Variation varied(const std::string& what, const std::string& value) {
  Variation variation;
  variation.what = what;
  variation.step = value;
  return variation;
}

TEST(Robustness, AnArteryBehindAClosedOstiumIsFoundAndToldAndAHeartInNoiseRefused) {
  Variation closed = varied("anatomy", "right ostium closed");
  closed.patient.anatomy = phantom::Anatomy::right_ostium_closed;
  Variation loud = varied("noise", "500 HU");
  loud.noise_hu = 500.0;
  // The superior vena cava is twice as bright as the aorta.
  Variation dim = varied("contrast", "200 HU");
  dim.patient.contrast_hu = 200.0;
  RobustnessOptions options;
  options.seeds = 1;
  options.voxel_mm = 1.5;
  const std::vector<RobustnessRun> runs = vary_patients({varied("as drawn", ""), loud, closed, dim}, options);
  const std::vector<RobustnessRow> rows = rows_of(runs);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_EQ(rows[0].refused, 0U);
  EXPECT_GT(rows[0].main_ov, 0.9);
  EXPECT_GE(rows[0].right, 3U);
  EXPECT_LT(rows[0].astray_mm, 5.0);
  EXPECT_GT(rows[2].main_ov, 0.9);
  EXPECT_LT(rows[2].astray_mm, 5.0);
  EXPECT_THAT(rows[2].told, Contains(HasSubstr("beyond the aorta's lumen")));
  EXPECT_EQ(rows[1].refused, 1U);
  EXPECT_EQ(rows[1].ov, 0.0);
  EXPECT_THAT(rows[1].told, Contains(HasSubstr("first vessel")));
  EXPECT_EQ(rows[3].refused, 0U);
  EXPECT_GT(rows[3].main_ov, 0.8);
  EXPECT_LT(rows[3].astray_mm, 5.0);
  EXPECT_THAT(robustness_json(runs, options), HasSubstr("\"kind\": \"robustness\""));
}

TEST(Robustness, AReportOfVariationsWithoutStepsHasNoPlot) {
  const auto folder = ostia::testing::temporary_folder("robustness");
  RobustnessRun run;
  run.variation = varied("stent", "18 mm in the proximal LAD");
  run.score.vessels.emplace_back();
  write_robustness_report(folder, {run});
  EXPECT_TRUE(std::filesystem::exists(folder / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(folder / "overlap.png"));
  run.variation = varied("noise", "40 HU");
  write_robustness_report(folder, {run});
  EXPECT_TRUE(std::filesystem::exists(folder / "overlap.png"));
}

TEST(Robustness, EachStepIsNamedOnceAndTheFirstIsThePatientAsDrawn) {
  const std::vector<Variation> all = usual_variations();
  EXPECT_EQ(all.front().what, "as drawn");
  std::set<std::string> names;
  for (const Variation& one : all)
    EXPECT_TRUE(names.insert(one.what + one.step).second) << one.what << one.step;
  EXPECT_GT(all.size(), 25U);
}

TEST(Robustness, RefusesWhatMakesNoSense) {
  RobustnessOptions options;
  options.seeds = 0;
  EXPECT_THROW(vary_patients(usual_variations(), options), InvalidInput);
  options = {};
  options.voxel_mm = 0.1;
  EXPECT_THROW(vary_patients(usual_variations(), options), InvalidInput);
}

}  // namespace
}  // namespace ostia::experiments
