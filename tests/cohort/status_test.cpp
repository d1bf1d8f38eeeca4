// What counts as done, and what only looks like it.

#include "ostia/cohort/status.h"

#include "made_results.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>

namespace ostia::cohort {
namespace {

namespace fs = std::filesystem;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// How many scans are in a state of a stage.
std::size_t count(const CohortStatus& status, std::size_t stage, StageState state) {
  return status.stages[stage].scans[static_cast<std::size_t>(state)];
}

TEST(CohortStatusRead, CountsEveryScanOnceAStage) {
  const MadeCohort cohort("status_counts", 4);
  cohort.make_all(0, "{}");
  cohort.make(1, 0, "image");
  cohort.make(1, 1, "case", ExitCode::quality_failed);
  cohort.make(2, 0, "image");
  cohort.record(2, 1, "3", "null", "no heart was found below the aorta (0 ml)");
  cohort.record(2, 2, "null", "null", "left out: extract has no result");
  const CohortStatus status = read_status(cohort.folder());
  EXPECT_EQ(status.scans, 4u);
  EXPECT_EQ(status.whole, 1u);
  EXPECT_THAT(status.stages[0].scans, ElementsAre(1, 3, 0, 0, 0, 0));
  EXPECT_THAT(status.stages[1].scans, ElementsAre(1, 1, 1, 1, 0, 0));
  EXPECT_THAT(status.stages[2].scans, ElementsAre(3, 1, 0, 0, 0, 0));
  EXPECT_DOUBLE_EQ(status.stages[0].seconds, 6.0);
  EXPECT_EQ(status.review.open, 2u);
  ASSERT_EQ(status.reasons.size(), 1u);
  EXPECT_EQ(status.reasons[0].stage, "extract");
  EXPECT_EQ(status.reasons[0].exit_code, 3);
  EXPECT_EQ(status.reasons[0].reason, "no heart was found below the aorta (# ml)");
  EXPECT_EQ(status.reasons[0].example, cohort.scan(2));
}

TEST(CohortStatusRead, ReasonsThatDifferInNumbersAreOneAndTheMostFrequentStandFirst) {
  const MadeCohort cohort("status_reasons", 4);
  cohort.record(0, 0, "null", "11", "ended by signal 11");
  cohort.record(1, 0, "3", "null", "slice 12 of 80.5 mm is missing");
  cohort.record(2, 0, "3", "null", "slice 7 of 3 mm is missing");
  core::write_file(cohort.folder() / "logs" / cohort.scan(3) / "import.json", "{ half");
  const CohortStatus status = read_status(cohort.folder());
  ASSERT_EQ(status.reasons.size(), 3u);
  EXPECT_EQ(status.reasons[0].reason, "slice # of # mm is missing");
  EXPECT_EQ(status.reasons[0].scans, 2u);
  EXPECT_EQ(count(status, 0, StageState::failed), 4u);
  EXPECT_EQ(status.reasons[1].exit_code + status.reasons[2].exit_code, 6 + 128 + 11);
}

TEST(CohortStatusRead, WhatIsHalfThereIsNotTrusted) {
  const MadeCohort cohort("status_half", 3);
  cohort.make(0, 0, "image");
  fs::remove(cohort.at(0, 0) / "manifest.json");  // as if it had been killed before it was whole
  cohort.make(1, 0, "image");
  fs::remove(cohort.at(1, 0) / stages[0].result);
  cohort.make(2, 0, "image");
  core::write_file(cohort.at(2, 0) / "manifest.json", "{");
  const CohortStatus status = read_status(cohort.folder());
  EXPECT_EQ(count(status, 0, StageState::waiting), 1u);
  EXPECT_EQ(count(status, 0, StageState::damaged), 2u);
}

TEST(CohortStatusRead, WhatWasKnownIsSeenToHaveChanged) {
  const MadeCohort cohort("status_changes", 1);
  cohort.make_all(0, "{}");
  EXPECT_EQ(read_status(cohort.folder()).whole, 1u);
  EXPECT_EQ(read_status(cohort.folder()).whole, 1u);  // as it is kept
  fs::rename(cohort.at(0, 3), cohort.beside("moved"));
  EXPECT_EQ(count(read_status(cohort.folder()), 3, StageState::waiting), 1u);
  fs::rename(cohort.beside("moved"), cohort.at(0, 3));
  EXPECT_EQ(read_status(cohort.folder()).whole, 1u);
  fs::rename(cohort.at(0, 3) / stages[3].result, cohort.beside("mesh.vtu"));
  EXPECT_EQ(count(read_status(cohort.folder()), 3, StageState::damaged), 1u);
  fs::rename(cohort.beside("mesh.vtu"), cohort.at(0, 3) / stages[3].result);
  EXPECT_EQ(read_status(cohort.folder()).whole, 1u);
}

TEST(CohortStatusRead, AResultOfAnotherResultIsStaleAndWhatFollowsWaits) {
  const MadeCohort cohort("status_stale", 1);
  cohort.make_all(0, "{}");
  cohort.make(0, 0, "another image");
  const CohortStatus status = read_status(cohort.folder());
  EXPECT_EQ(count(status, 0, StageState::ok), 1u);
  EXPECT_EQ(count(status, 1, StageState::stale), 1u);
  for (const std::size_t later : {2u, 3u, 4u, 5u}) EXPECT_EQ(count(status, later, StageState::waiting), 1u);
}

TEST(CohortStatusRead, AChangedFileIsFoundWhereDigestsAreAskedFor) {
  const MadeCohort cohort("status_verify", 1);
  cohort.make_all(0, "{}");
  core::write_file(cohort.at(0, 3) / stages[3].result, "MESH");
  EXPECT_EQ(read_status(cohort.folder()).whole, 1u);
  EXPECT_EQ(count(read_status(cohort.folder(), {true}), 3, StageState::damaged), 1u);
}

TEST(CohortStatusRead, WhatIsNoCohortIsSaidToBeNone) {
  const auto said = [](const fs::path& folder) -> std::string {
    try {
      read_status(folder);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "";
  };
  const fs::path folder = ostia::testing::temporary_folder("status_none");
  EXPECT_THAT(said(folder), HasSubstr("it is no cohort"));
  core::write_file(folder / database_name, std::string(4096, 'x'));
  EXPECT_THAT(said(folder), HasSubstr("damaged or no cohort's"));
  const MadeCohort newer("status_newer", 1);
  Store(newer.folder() / database_name, Store::Mode::write)
      .execute("UPDATE meta SET value = '2' WHERE key = 'v'");
  EXPECT_THAT(said(newer.folder()), HasSubstr("newer version"));
}

}  // namespace
}  // namespace ostia::cohort
