#include "ostia/session/replay.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session {
namespace {

using namespace testing;

TEST(Replay, GivesTheStoredModelToTheLastBit) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(ring(10.0, 1.8));
  file.apply(renamed("dropped"));
  file.undo();
  for (const double by : {0.1, 0.3}) file.apply_merged(drag(20.0, by));
  file.annotate(added(analysis::MeasureKind::stenosis));  // not replayed
  file.apply(lumen::AxisTrim{tube_vessel, 27.0});
  file.annotate(marked("trimmed"));
  file.apply(ring(5.0, 1.1));
  file.undo();
  const ReplayReport report = replay(file);
  EXPECT_EQ(report.edits, 3U);
  EXPECT_TRUE(report.same());
  EXPECT_EQ(report.stored_digest, lumen::digest(*file.model()));

  write_edits(folder / "edits.jsonl", file.edits());
  const auto edits = read_edits(folder / "edits.jsonl");
  EXPECT_EQ(lumen::digest(replayed(tube_model(), edits)), report.stored_digest);
}

TEST(Replay, NamesTheEditThatDoesNotFit) {
  const std::vector<lumen::Edit> edits{renamed("a"), lumen::VesselRename{99, "b"}};
  try {
    replayed(tube_model(), edits);
    FAIL();
  } catch (const InvalidInput& e) {
    EXPECT_THAT(std::string(e.what()), ::testing::HasSubstr("edit 2 of 2"));
  }
}

TEST(Replay, CanBeCancelled) {
  const core::TaskContext task;
  task.cancel();
  EXPECT_THROW(replayed(tube_model(), {renamed("a")}, task), Cancelled);
}

}  // namespace
}  // namespace ostia::session
