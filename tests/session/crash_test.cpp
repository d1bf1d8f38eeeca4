#include "crash_runs.h"

namespace ostia::session {
namespace {

TEST(Crash, TenKillsLoseAtMostTheEditInFlight) {
  testing::expect_nothing_lost(10, 50);
}

TEST(Crash, CrashRecoverAndCrashAgain) {
  const testing::TempFolder folder;
  const auto path = folder / "a.ostia";
  { CaseFile::create(path, testing::tube_model()); }
  std::size_t before = 1;
  for (int k = 0; k < 4; ++k) {
    const int returned = testing::killed_session(path, 50, {8 + 9 * k, std::chrono::microseconds(300 * k)});
    const CaseFile file = CaseFile::open(path, k % 2 ? OpenMode::read_only : OpenMode::read_write);
    EXPECT_TRUE(replay(file).same());
    EXPECT_GE(file.journal().size(), before);
    if (returned > 0) {
      EXPECT_GT(file.journal().size(), before);
    }
    before = file.journal().size();
  }
}

}  // namespace
}  // namespace ostia::session
