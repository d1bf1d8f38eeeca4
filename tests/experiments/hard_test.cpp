#include "ostia/experiments/hard.h"

#include "hard/hard_truth.h"
#include "shared_data.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>

namespace ostia::experiments {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::ThrowsMessage;

HardOptions coarse_cases() {
  HardOptions options;
  options.cases = 1;
  options.voxel_mm = 2.0;
  options.search = false;
  return options;
}

TEST(HardExperiment, IsCancelledAndRefusesWhatMakesNoSense) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(run_hard(coarse_cases(), {}, task), Cancelled);
  HardOptions options = coarse_cases();
  options.cases = 0;
  EXPECT_THAT([&] { run_hard(options); }, ThrowsMessage<InvalidInput>(HasSubstr("1 to 100 cases, not 0")));
  options = coarse_cases();
  options.voxel_mm = 0.1;
  EXPECT_THROW(run_hard(options), InvalidInput);
  options = coarse_cases();
  options.strength.noise = 9.0;
  EXPECT_THROW(run_hard(options), InvalidInput);
}

TEST(HardExperiment, NamesTheFolderWithoutMasksAndTheFileThatIsNone) {
  const fs::path folder = testing::temporary_folder("masks");
  core::write_file(folder / "notes.txt", "no mask");
  EXPECT_THAT(
      [&] { read_hard_patients(folder); },
      ThrowsMessage<InvalidInput>(AllOf(HasSubstr(folder.filename().string()), HasSubstr("holds no masks"))));
  EXPECT_THROW(read_hard_patients(folder / "nowhere"), InvalidInput);
  core::write_file(folder / "one.nrrd", "not an image");
  EXPECT_THAT([&] { read_hard_patients(folder); }, ThrowsMessage<InvalidInput>(HasSubstr("one.nrrd")));
}

TEST(HardTruth, IsTheMeanOfTheTracesWhereSomebodyTracedAndExactElsewhere) {
  using geometry::Vec3;
  phantom::ChallengeVessel lad;
  lad.name = "LAD";
  lad.observers.resize(2);
  for (int i = 0; i <= 300; ++i) {
    lad.reference.points.push_back(Vec3(0.0, 0.0, 0.1 * i));
    lad.reference.radius.push_back(2.0 - 0.001 * i);
    lad.reference.observer_spread.push_back(0.2);
    if (i % 3 != 0) continue;
    lad.observers[0].push_back(Vec3(0.5, 0.0, 0.1 * i));
    lad.observers[1].push_back(Vec3(0.1, -0.4, 0.1 * i));
  }
  phantom::CasePlan plan;
  plan.challenge.vessels = {lad};
  const ExtractionTruth exact{
      "seed 1", {}, {{"LAD", true, lad.reference}, {"OM1", false, lad.reference}}, {}, {}};
  const ExtractionTruth traced = truth_as_traced(plan, exact);
  ASSERT_EQ(traced.vessels.size(), 2U);
  const io::RotterdamReference& mean = traced.vessels[0].reference;
  ASSERT_EQ(mean.points.size(), 101U);
  EXPECT_LT((mean.points[50] - Vec3(0.3, -0.2, 15.0)).norm(), 1e-9);
  EXPECT_NEAR(mean.radius[50], 1.85, 1e-9);
  EXPECT_EQ(mean.radius.size(), mean.points.size());
  EXPECT_EQ(mean.observer_spread.size(), mean.points.size());
  EXPECT_EQ(traced.vessels[1].reference.points, lad.reference.points) << "nobody traced it";
  plan.challenge.vessels[0].observers.clear();
  EXPECT_EQ(truth_as_traced(plan, exact).vessels[0].reference.points, lad.reference.points);
}

}  // namespace
}  // namespace ostia::experiments
