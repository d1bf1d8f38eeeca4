#include "ostia/session/sample_case.h"

#include "case_tools.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

namespace ostia::session {
namespace {

namespace fs = std::filesystem;
using testing::TempFolder;

TEST(SampleCase, CancelledItLeavesNothing) {
  const TempFolder folder;
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(sample_case(folder / "sample", phantom::Preset::tiny, task), Cancelled);
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

}  // namespace
}  // namespace ostia::session
