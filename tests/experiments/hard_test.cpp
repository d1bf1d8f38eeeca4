#include "ostia/experiments/hard.h"

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

}  // namespace
}  // namespace ostia::experiments
