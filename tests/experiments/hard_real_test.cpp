#include "shared_data.h"

#include "ostia/experiments/hard.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace ostia::experiments {
namespace {

TEST(HardExperimentReal, HeartsAroundPatientsStandInRowsOfTheirOwn) {
  OSTIA_REQUIRE_SHARED(mask, "coronary/patient-masks/patient001.nrrd");
  const auto folder = testing::temporary_folder("hard-real");
  std::filesystem::copy_file(mask, folder / "one.nrrd");
  const std::vector<HardPatient> patients = read_hard_patients(folder);
  ASSERT_EQ(patients.size(), 1U);
  EXPECT_EQ(patients[0].name, "one");
  EXPECT_DOUBLE_EQ(patients[0].tree->rim_mm, 0.5);
  HardOptions options;
  options.cases = 1;
  options.voxel_mm = 1.5;
  options.search = false;
  const std::vector<HardRun> runs = run_hard(options, patients);
  ASSERT_EQ(runs.size(), 2U);
  EXPECT_EQ(runs[0].patient, "");
  EXPECT_EQ(runs[1].patient, "one");
  EXPECT_EQ(runs[1].draw.noise_hu, runs[0].draw.noise_hu) << "the same scanner";
  const std::vector<HardRow> rows = rows_of(runs, options.scores);
  ASSERT_EQ(rows.size(), 4U);
  EXPECT_FALSE(rows[0].patients);
  EXPECT_TRUE(rows[2].patients);
  EXPECT_EQ(rows[2].summary.annotated.vessels, 4U);
  EXPECT_GT(rows[2].summary.annotated.ov, 0.5) << "between true ends";
}

}  // namespace
}  // namespace ostia::experiments
