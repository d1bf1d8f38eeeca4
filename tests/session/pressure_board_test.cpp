// Pressures that follow a hand: only what an edit changed is computed, and gives what the whole gives.

#include "ostia/session/pressure_board.h"

#include "report_cases.h"

#include "ostia/core/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct PressureBoardTest : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  PressureBoard board{bench};

  void open(const lumen::LumenModel& model) {
    static int number = 0;
    const fs::path path = folder / (std::to_string(++number) + ".ostia");
    CaseFile::create(path, model);
    bench.set_session(Session::open(path));
  }
  /// Does the next piece of work, in this thread.
  bool work_once() {
    const auto work = board.begin();
    if (!work) return false;
    board.take(*work, work->found());
    return true;
  }
  void work_all() {
    for (int i = 0; i < 10 && work_once(); ++i) {
    }
  }
  double end_ffr(std::int32_t vessel = tube_vessel) { return *ffr_at(*board.now(), vessel, 1e9); }
  /// As if nothing had been known before.
  double whole_ffr(std::int32_t vessel = tube_vessel) {
    PressureReportOptions options;
    options.conditions = conditions_of(board.notes());
    const auto surface_of = [this](std::int32_t one) { return bench.session().live().surface(one); };
    return *ffr_at(make_pressure_report(pressure_tree(*bench.model(), surface_of), options), vessel, 1e9);
  }
};

TEST_F(PressureBoardTest, ComputesNothingBeforeItIsWanted) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8));
  EXPECT_FALSE(board.begin());
  int told = 0;
  const Subscription wanted = board.wanted.observe([&] { ++told; });
  board.shown.set(true);
  EXPECT_GT(told, 0);
  EXPECT_TRUE(board.behind());
  const auto work = board.begin();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->whole());
  EXPECT_FALSE(board.begin()) << "one at a time";
  board.take(*work, work->found());
  EXPECT_FALSE(board.behind());
  EXPECT_NEAR(end_ffr(), whole_ffr(), 1e-9);
  EXPECT_FALSE(board.now()->uncertainty);
  EXPECT_TRUE(board.band_to_come());
  const auto sure = board.begin();
  ASSERT_TRUE(sure);
  EXPECT_TRUE(sure->band);
  EXPECT_FALSE(board.behind()) << "the numbers are those of the walls";
  board.take(*sure, sure->found());
  const auto interval = ffr_interval_at(*board.now(), tube_vessel, 50.0);
  ASSERT_TRUE(interval);
  EXPECT_LT(interval->low, end_ffr());
  EXPECT_GT(interval->high, end_ffr());
  EXPECT_FALSE(board.begin());
  EXPECT_FALSE(board.band_to_come());
}

TEST_F(PressureBoardTest, HowSureItIsGoesWithTheWallThatItWasOf) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8));
  board.shown.set(true);
  work_all();
  ASSERT_TRUE(board.now()->uncertainty);
  bench.edit(ring(25.0, 0.7));
  work_all();
  EXPECT_FALSE(board.now()->uncertainty) << "not before the hand rests";
  board.rested();
  const auto whole = board.begin();
  ASSERT_TRUE(whole);
  EXPECT_TRUE(whole->whole());
  board.take(*whole, whole->found());
  const auto band = board.begin();
  ASSERT_TRUE(band);
  board.take(*band, nullptr);  // cancelled
  EXPECT_TRUE(board.band_to_come());
  work_all();
  EXPECT_TRUE(board.now()->uncertainty);
}

TEST_F(PressureBoardTest, AnEditOfAWallIsFollowedByItsBranchAndGivesWhatTheWholeGives) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 1.0));
  board.shown.set(true);
  work_all();
  const double before = end_ffr();
  for (const double radius : {0.8, 0.65}) {
    bench.edit(ring(25.0, radius));
    EXPECT_TRUE(board.small_waits());
    const auto work = board.begin();
    ASSERT_TRUE(work);
    EXPECT_FALSE(work->whole());
    ASSERT_THAT(work->moved, SizeIs(1));
    EXPECT_LT(work->moved[0].to_mm - work->moved[0].from_mm, 40.0) << "not the whole vessel";
    board.take(*work, work->found());
    EXPECT_NEAR(end_ffr(), whole_ffr(), 0.002);
  }
  EXPECT_LT(end_ffr(), before - 0.02);
  bench.undo();
  bench.undo();
  work_all();
  EXPECT_NEAR(end_ffr(), before, 0.002);
}

TEST_F(PressureBoardTest, AfterRestAllIsMeasuredAnew) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 1.0));
  board.shown.set(true);
  work_all();
  board.rested();
  EXPECT_FALSE(board.begin()) << "nothing was edited";
  bench.edit(ring(25.0, 0.7));
  work_all();
  board.rested();
  const auto work = board.begin();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->whole());
  bench.edit(ring(26.0, 0.7));  // meanwhile
  board.take(*work, nullptr);   // cancelled
  const auto next = board.begin();
  ASSERT_TRUE(next);
  EXPECT_FALSE(next->whole()) << "what follows the hand goes first";
  board.take(*next, next->found());
  const auto last = board.begin();
  ASSERT_TRUE(last);
  EXPECT_TRUE(last->whole());
  board.take(*last, last->found());
  EXPECT_NEAR(end_ffr(), whole_ffr(), 1e-9);
}

TEST_F(PressureBoardTest, InputsAreStepsAndChangeWhatIsShown) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.7));
  board.shown.set(true);
  work_all();
  const double before = end_ffr();
  board.set_input("rest_flow_ml_min", 150.0);
  const auto work = board.begin();
  ASSERT_TRUE(work);
  EXPECT_FALSE(work->whole());
  EXPECT_THAT(work->moved, IsEmpty());
  board.take(*work, work->found());
  EXPECT_LT(end_ffr(), before - 0.01);
  EXPECT_NEAR(end_ffr(), whole_ffr(), 1e-9);
  bench.undo();
  work_all();
  EXPECT_NEAR(end_ffr(), before, 1e-9);
  EXPECT_THROW(board.set_input("systolic_mmhg", 20.0), InvalidInput);
  EXPECT_FALSE(board.begin());
  bench.redo();
  work_all();
  board.set_input("rest_flow_ml_min", std::nullopt);
  EXPECT_THAT(board.notes().inputs, IsEmpty());
}

TEST_F(PressureBoardTest, WhatIfIsComputedBesideIt) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.6));
  board.shown.set(true);
  work_all();
  EXPECT_FALSE(board.now()->after);
  bench.stenoses(tube_vessel);
  bench.cursor_mm.set(25.0);
  const WhatIf stretch = board.stretch_at_cursor();
  EXPECT_NEAR(0.5 * (stretch.from_mm + stretch.to_mm), 25.0, 2.0);
  const double before = end_ffr();
  board.add_what_if(stretch);
  work_all();
  ASSERT_TRUE(board.now()->after);
  EXPECT_GT(*ffr_after_at(*board.now(), tube_vessel, 59.0), before + 0.05);
  EXPECT_NEAR(end_ffr(), before, 1e-9);
  bench.edit(ring(40.0, 1.0));  // it follows edits, too
  work_all();
  EXPECT_TRUE(board.now()->after);
  board.remove_what_if(0);
  work_all();
  EXPECT_FALSE(board.now()->after);
  bench.undo();
  work_all();
  EXPECT_TRUE(board.now()->after);
  EXPECT_THROW(board.remove_what_if(5), InvalidInput);
  board.clear_what_ifs();
  EXPECT_THAT(board.notes().what_ifs, IsEmpty());
  bench.cursor_mm.set(50.0);
  EXPECT_NEAR(board.stretch_at_cursor().to_mm - board.stretch_at_cursor().from_mm, 15.0, 1e-9);
}

TEST_F(PressureBoardTest, AnotherCaseForgetsAndWorkOfTheFormerIsDropped) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8));
  board.shown.set(true);
  const auto work = board.begin();
  ASSERT_TRUE(work);
  open(narrowed_tube("RCA", 50.0, 1.6, 25.0, 1.6));
  EXPECT_FALSE(board.now());
  board.take(*work, work->found());
  EXPECT_FALSE(board.now()) << "it was of another case";
  work_all();
  ASSERT_TRUE(board.now());
  EXPECT_EQ(board.now()->tree.network.branches[0].name, "RCA");
  bench.close_case();
  EXPECT_FALSE(board.now());
  EXPECT_FALSE(board.begin());
}

TEST_F(PressureBoardTest, AnotherTreeIsMeasuredWhole) {
  open(named_y());
  board.shown.set(true);
  work_all();
  bench.edit(lumen::BranchDelete{bench.model()->tree.vessels[1].id});
  EXPECT_FALSE(board.now());
  const auto work = board.begin();
  ASSERT_TRUE(work);
  EXPECT_TRUE(work->whole());
  board.take(*work, work->found());
  EXPECT_THAT(board.now()->network->outlets(), SizeIs(1));
}

TEST_F(PressureBoardTest, WhatFailsIsSaidAndTriedAgainAfterAnEdit) {
  open(narrowed_tube("LAD", 60.0, 1.6, 25.0, 0.8));
  board.shown.set(true);
  auto work = board.begin();
  ASSERT_TRUE(work);
  board.take(*work, nullptr, "the pressures of the tree do not settle");
  EXPECT_FALSE(board.now());
  EXPECT_THAT(board.problem(), HasSubstr("do not settle"));
  EXPECT_FALSE(board.begin()) << "not again and again";
  EXPECT_FALSE(board.ffr_at_cursor());
  bench.edit(ring(25.0, 1.0));
  work_all();
  EXPECT_TRUE(board.now());
  EXPECT_THAT(board.problem(), IsEmpty());
}

}  // namespace
}  // namespace ostia::session::testing
