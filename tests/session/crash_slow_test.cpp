#include "crash_runs.h"

namespace ostia::session {
namespace {

TEST(Crash, TwoHundredKillsOfAThousandEdits) {
  testing::expect_nothing_lost(200, 1000);
}

}  // namespace
}  // namespace ostia::session
