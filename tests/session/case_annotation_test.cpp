// Measurements and marks in a case file: one journal and one order of undo with the edits.

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <sys/wait.h>

#include <csignal>

namespace ostia::session {
namespace {

using namespace testing;
using analysis::MeasureKind;
using lumen::digest;
using ::testing::ElementsAre;
using ::testing::IsEmpty;

std::string state(const CaseFile& file) {
  return digest(*file.model()) + text_of(*file.annotations());
}

std::vector<std::string> ops(const CaseFile& file) {
  std::vector<std::string> names;
  for (const JournalEntry& entry : file.journal()) names.push_back(entry.op);
  return names;
}

TEST(CaseAnnotation, KeepsEveryKindToTheLastBit) {
  const TempFolder folder;
  std::string before;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    EXPECT_EQ(text_of(*file.annotations()), text_of({}));
    std::int32_t id = 0;
    for (const MeasureKind kind : all_kinds)
      EXPECT_THAT(file.annotate(added(kind)).measurements, ElementsAre(++id));
    EXPECT_THAT(file.annotate(marked("calcified")).marks, ElementsAre(tube_vessel));
    before = text_of(*file.annotations());
  }
  for (const OpenMode mode : {OpenMode::read_write, OpenMode::read_only}) {
    const CaseFile file = CaseFile::open(folder / "a.ostia", mode);
    EXPECT_EQ(text_of(*file.annotations()), before);
    ASSERT_EQ(file.annotations()->measurements.size(), all_kinds.size());
    for (std::size_t i = 0; i < all_kinds.size(); ++i) {
      analysis::Measurement expected = measurement(all_kinds[i]);
      expected.id = static_cast<std::int32_t>(i) + 1;
      EXPECT_TRUE(same(file.annotations()->measurements[i], expected));
    }
    EXPECT_TRUE(same(file.annotations()->marks.at(0), marked("calcified").mark));
  }
}

TEST(CaseAnnotation, UndoAndRedoGoThroughEditsAndAnnotationsInOneOrder) {
  const TempFolder folder;
  std::vector<std::string> states;
  std::vector<bool> edited;
  {
    CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
    const auto then = [&](bool edit) {
      states.push_back(state(file));
      edited.push_back(edit);
    };
    then(true);
    file.annotate(added(MeasureKind::distance)), then(false);
    file.apply(ring(10.0, 1.8)), then(true);
    file.annotate(moved(file, 1, 3.0)), then(false);
    file.annotate(marked("seen")), then(false);
    file.apply(renamed("LAD prox")), then(true);
    file.annotate(MeasureDelete{1}), then(false);
    file.annotate(marked("seen again", false)), then(false);
  }
  for (std::size_t i = states.size() - 1; i-- > 0;) {
    CaseFile file = CaseFile::open(folder / "a.ostia");
    const auto undone = file.undo();
    ASSERT_TRUE(undone);
    EXPECT_EQ(state(file), states[i]);
    EXPECT_EQ(undone->edited, edited[i + 1]);
    EXPECT_EQ(undone->annotations.empty(), edited[i + 1]);
    EXPECT_EQ(digest(undone->edit.model), digest(*file.model()));
    if (!undone->edited) {
      EXPECT_THAT(undone->edit.changes, IsEmpty());
    }
  }
  EXPECT_FALSE(CaseFile::open(folder / "a.ostia").undo());
  for (std::size_t i = 1; i < states.size(); ++i) {
    CaseFile file = CaseFile::open(folder / "a.ostia");
    ASSERT_TRUE(file.redo());
    EXPECT_EQ(state(file), states[i]);
  }
  CaseFile file = CaseFile::open(folder / "a.ostia");
  EXPECT_FALSE(file.redo());
  EXPECT_EQ(file.edits().size(), 2U);
}

TEST(CaseAnnotation, UndoOfAnAnnotationAsksNoSolver) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  const auto model = file.model();
  file.annotate(marked("seen"));
  const auto refuse = [](const lumen::EditOutcome&) { throw NumericalError("cannot be solved"); };
  EXPECT_NO_THROW(file.undo(refuse));
  EXPECT_NO_THROW(file.redo(refuse));
  EXPECT_EQ(file.model(), model);  // not even read again
}

TEST(CaseAnnotation, AnotherCommandOfEitherKindDropsTheRedo) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(renamed("one"));
  file.undo();
  file.annotate(marked("seen"));
  EXPECT_FALSE(file.redo());
  file.undo();
  file.apply(renamed("two"));
  EXPECT_FALSE(file.redo());
  EXPECT_THAT(file.annotations()->marks, IsEmpty());
  EXPECT_THAT(ops(file),
              ElementsAre("case.begin", "vessel.rename", "undo", "vessel.mark", "undo", "vessel.rename"));
  const auto journal = file.journal();
  EXPECT_TRUE(journal[1].dropped && journal[3].dropped);
  EXPECT_FALSE(journal[5].undone);
  EXPECT_EQ(journal[0].kind, StepKind::begin);
  EXPECT_EQ(journal[1].kind, StepKind::edit);
  EXPECT_EQ(journal[2].kind, StepKind::travel);
  EXPECT_EQ(journal[3].kind, StepKind::annotation);
}

TEST(CaseAnnotation, ADragIsOneStep) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  const std::string before = state(file);
  file.annotate_merged(added(MeasureKind::distance), 1);
  for (const double x : {1.0, 2.0, 2.5}) file.annotate_merged(moved(file, 1, x), 1);
  EXPECT_THAT(ops(file), ElementsAre("case.begin", "measure.add"));
  EXPECT_EQ(file.annotations()->measurements[0].points[1].x(), 2.5);
  // What the journal says is the measurement as it was left.
  const auto command = std::get<MeasureAdd>(annotation_of_json(file.journal()[1].parameters));
  EXPECT_TRUE(same(command.measurement, file.annotations()->measurements[0]));
  const std::string drawn = state(file);
  for (const double x : {3.0, 4.0}) file.annotate_merged(moved(file, 1, x), 2);  // taken up once more
  EXPECT_THAT(ops(file), ElementsAre("case.begin", "measure.add", "measure.change"));
  const std::string dragged = state(file);
  file.undo();
  EXPECT_EQ(state(file), drawn);
  file.undo();
  EXPECT_EQ(state(file), before);
  file.redo(), file.redo();
  EXPECT_EQ(state(file), dragged);
}

TEST(CaseAnnotation, ADragEndsWithAnyOtherCommand) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.annotate(added(MeasureKind::distance));
  file.annotate(added(MeasureKind::distance));
  const auto steps = [&] { return file.journal().size(); };
  const std::size_t first = steps();
  file.annotate_merged(moved(file, 1, 1.0), 5);
  file.annotate_merged(moved(file, 2, 1.0), 5);  // another measurement
  file.annotate_merged(moved(file, 1, 2.0), 5);
  EXPECT_EQ(steps(), first + 3);
  file.annotate_merged(marked("a"), 5);
  file.annotate_merged(marked("ab"), 5);  // typed on
  EXPECT_EQ(steps(), first + 4);
  file.annotate(marked("abc"));
  file.annotate_merged(marked("abcd"), 5);
  EXPECT_EQ(steps(), first + 6);
  file.apply_merged(drag(15.0, 0.1));
  file.annotate_merged(marked("abcde"), 5);
  EXPECT_EQ(steps(), first + 8);
  file.apply_merged(drag(15.0, 0.2));  // an annotation came between: not the drag from before
  EXPECT_EQ(steps(), first + 9);
  EXPECT_EQ(file.edits().size(), 2U);
  file.undo();
  file.annotate_merged(moved(file, 1, 7.0), 5);
  file.undo();
  file.annotate_merged(moved(file, 1, 8.0), 5);  // after an undo
  EXPECT_EQ(
      std::get<MeasureChange>(annotation_of_json(file.next_undo()->parameters)).measurement.points[1].x(),
      8.0);
  const std::int64_t number = file.next_undo()->number;
  file = CaseFile::create(folder / "b.ostia", tube_model());  // closes the first
  file = CaseFile::open(folder / "a.ostia");
  file.annotate_merged(moved(file, 1, 9.0), 5);  // after a restart
  EXPECT_EQ(file.next_undo()->number, number + 1);
}

TEST(CaseAnnotation, ADragBackToItsPlaceCanBeUndone) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.annotate(added(MeasureKind::distance));
  const double at = file.annotations()->measurements[0].points[1].x();
  const std::string before = state(file);
  for (const double x : {1.0, at}) file.annotate_merged(moved(file, 1, x), 3);
  EXPECT_EQ(state(file), before);
  ASSERT_TRUE(file.undo());
  EXPECT_EQ(state(file), before);
  ASSERT_TRUE(file.redo());
  EXPECT_EQ(state(file), before);
}

TEST(CaseAnnotation, WhatChangesNothingIsNoStep) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.annotate(marked("seen"));
  file.annotate(added(MeasureKind::distance));
  file.undo();
  EXPECT_TRUE(file.annotate(marked("seen")).empty());
  EXPECT_EQ(file.journal().size(), 4U);
  EXPECT_TRUE(file.redo());  // and drops none
}

TEST(CaseAnnotation, ARefusedCommandChangesNothing) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.annotate(added(MeasureKind::distance));
  file.annotate(marked("seen"));
  file.undo();
  const std::string before = state(file);
  EXPECT_THROW(file.annotate(MeasureDelete{7}), InvalidInput);
  EXPECT_THROW(file.annotate(added(MeasureKind::volume, 99)), InvalidInput);
  EXPECT_THROW(file.annotate_merged(marked("x", true, 99), 1), InvalidInput);
  EXPECT_EQ(state(file), before);
  EXPECT_EQ(file.journal().size(), 4U);
  EXPECT_TRUE(file.redo());
  file = CaseFile::create(folder / "b.ostia", tube_model());  // closes the first
  CaseFile reading = CaseFile::open(folder / "a.ostia", OpenMode::read_only);
  EXPECT_THROW(reading.annotate(marked("x")), IoError);
  EXPECT_THROW(reading.annotate_merged(marked("x"), 1), IoError);
  EXPECT_THROW(reading.go_to_step(1), IoError);
}

TEST(CaseAnnotation, ADeletedVesselsAnnotationsAreKept) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", y_model());
  const std::int32_t vessel = file.model()->vessels.back()->vessel;
  file.annotate(added(MeasureKind::stenosis, vessel));
  file.annotate(marked("tight", true, vessel));
  const std::string before = text_of(*file.annotations());
  file.apply(lumen::BranchDelete{vessel});
  EXPECT_EQ(text_of(*file.annotations()), before);
  EXPECT_THAT(find_orphans(*file.annotations(), *file.model()).measurements, ElementsAre(1));
  EXPECT_THAT(find_orphans(*file.annotations(), *file.model()).marks, ElementsAre(vessel));
  file = CaseFile::create(folder / "b.ostia", y_model());  // closes the first
  file = CaseFile::open(folder / "a.ostia");
  EXPECT_EQ(text_of(*file.annotations()), before);
  file.undo();
  EXPECT_THAT(find_orphans(*file.annotations(), *file.model()).measurements, IsEmpty());
}

TEST(CaseAnnotation, ACopyHasThemToo) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.annotate(added(MeasureKind::distance));
  file.annotate(marked("seen"));
  file.undo();
  file.copy_to(folder / "b.ostia");
  CaseFile copy = CaseFile::open(folder / "b.ostia");
  EXPECT_EQ(state(copy), state(file));
  ASSERT_TRUE(copy.redo());
  EXPECT_EQ(copy.annotations()->marks.size(), 1U);
}

TEST(CaseAnnotation, AStepIsReachedInOneGo) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", y_model());
  const std::int32_t first = file.model()->vessels.front()->vessel,
                     last = file.model()->vessels.back()->vessel;
  std::map<std::int64_t, std::string> states;
  const auto then = [&] { states[file.next_undo() ? file.next_undo()->number : 1] = state(file); };
  then();
  file.apply(lumen::VesselRename{first, "one"}), then();
  file.annotate(marked("seen", true, last)), then();
  file.apply(lumen::BranchDelete{last}), then();
  file.annotate(added(MeasureKind::distance)), then();
  file.apply(lumen::VesselRename{first, "two"}), then();
  ASSERT_EQ(states.size(), 6U);
  for (const std::int64_t from : {1, 2, 3, 4, 5, 6})
    for (const std::int64_t to : {1, 2, 3, 4, 5, 6}) {
      SCOPED_TRACE(std::to_string(from) + " to " + std::to_string(to));
      file.go_to_step(from);
      EXPECT_EQ(state(file), states[from]);
      const auto before = file.model();
      const auto gone = file.go_to_step(to);
      EXPECT_EQ(state(file), states[to]);
      EXPECT_EQ(gone.has_value(), from != to);
      if (!gone) continue;
      // The branch went or came, in one list, wherever the deleting step lies between.
      const bool branch = (from < 4) != (to < 4);
      EXPECT_EQ(std::any_of(gone->edit.changes.begin(), gone->edit.changes.end(),
                            [&](const auto& change) { return change.vessel == last && change.axis_changed; }),
                branch);
      EXPECT_EQ(!gone->annotations.marks.empty(), (from < 3) != (to < 3));
      EXPECT_EQ(!gone->annotations.measurements.empty(), (from < 5) != (to < 5));
    }
  file.go_to_step(4);
  EXPECT_EQ(file.next_redo()->number, 5);
  file = CaseFile::create(folder / "b.ostia", y_model());  // closes the first
  EXPECT_EQ(state(CaseFile::open(folder / "a.ostia")), states[4]);
}

TEST(CaseAnnotation, OnlyStepsCanBeReached) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(renamed("one"));    // 2
  file.apply(renamed("two"));    // 3
  file.undo();                   // 4
  file.apply(renamed("three"));  // 5, and 3 is dropped
  const std::string before = state(file);
  for (const std::int64_t number : {-1, 0, 3, 4, 6}) EXPECT_THROW(file.go_to_step(number), InvalidInput);
  EXPECT_EQ(state(file), before);
  const auto refuse = [](const lumen::EditOutcome&) { throw NumericalError("cannot be solved"); };
  EXPECT_THROW(file.go_to_step(1, refuse), NumericalError);
  EXPECT_EQ(state(file), before);
  EXPECT_EQ(file.journal().size(), 5U);
  ASSERT_TRUE(file.go_to_step(1));
  EXPECT_THAT(ops(file), ElementsAre("case.begin", "vessel.rename", "vessel.rename", "undo", "vessel.rename",
                                     "undo", "undo"));
  EXPECT_FALSE(file.next_undo());
  EXPECT_EQ(file.next_redo()->number, 2);
}

TEST(CaseAnnotation, AFullDiskKeepsTheOldState) {
  const TempFolder folder;
  { CaseFile::create(folder / "a.ostia", tube_model()); }
  const auto tried = [&] {
    std::signal(SIGXFSZ, SIG_IGN);
    CaseFile file = CaseFile::open(folder / "a.ostia");
    file.annotate(added(MeasureKind::distance));
    file.apply(renamed("one"));
    const std::string before = state(file);
    rlimit limit{};
    ::getrlimit(RLIMIT_FSIZE, &limit);
    limit.rlim_cur = 4096;  // less than the next commit needs
    ::setrlimit(RLIMIT_FSIZE, &limit);
    const auto refused = [](const auto& command) {
      try {
        command();
        return false;
      } catch (const ResourceError&) {
        return true;
      }
    };
    if (!refused([&] { file.annotate(marked("seen")); })) return 1;
    if (!refused([&] { file.annotate_merged(moved(file, 1, 3.0), 1); })) return 2;
    if (!refused([&] { file.go_to_step(1); })) return 3;
    if (state(file) != before || file.journal().size() != 3) return 4;
    limit.rlim_cur = limit.rlim_max;
    ::setrlimit(RLIMIT_FSIZE, &limit);
    file.annotate(marked("seen"));  // there is room again
    return 0;
  };
  const pid_t child = ::fork();
  if (child == 0) ::_exit(tried());
  int status = 0;
  ::waitpid(child, &status, 0);
  ASSERT_TRUE(WIFEXITED(status));
  EXPECT_EQ(WEXITSTATUS(status), 0);
  EXPECT_EQ(CaseFile::open(folder / "a.ostia").annotations()->marks.size(), 1U);
}

}  // namespace
}  // namespace ostia::session
