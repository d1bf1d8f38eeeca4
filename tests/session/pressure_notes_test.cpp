// What a case keeps of its pressures: steps that are undone, redone, stored and opened; what is refused.

#include "ostia/session/pressure_notes.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/replay.h"
#include "ostia/session/workbench.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct PressureNotesInCase : ::testing::Test {
  TempFolder folder;
  fs::path path = folder / "a.ostia";
  CaseFile file = CaseFile::create(path, tube_model());
  const PressureNotes& notes() { return file.annotations()->pressure; }
  std::string refusal(const AnnotationCommand& command) {
    try {
      file.annotate(command);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(PressureNotesInCase, AreStepsThatAreUndoneAndRedoneToTheLastBit) {
  const std::string digest = lumen::digest(*file.model());
  const AnnotationChange change = file.annotate(told_inputs());
  EXPECT_TRUE(change.pressure);
  EXPECT_THAT(change.marks, IsEmpty());
  file.annotate(opened());
  const PressureNotes both = notes();
  EXPECT_EQ(both.inputs, told_inputs().inputs);
  EXPECT_EQ(both.what_ifs, opened().what_ifs);
  const auto back = file.undo();
  ASSERT_TRUE(back);
  EXPECT_FALSE(back->edited) << "the lumen is as it was";
  EXPECT_TRUE(back->annotations.pressure);
  EXPECT_THAT(notes().what_ifs, IsEmpty());
  EXPECT_EQ(notes().inputs, told_inputs().inputs);
  ASSERT_TRUE(file.undo());
  EXPECT_THAT(notes().inputs, IsEmpty());
  ASSERT_TRUE(file.redo());
  ASSERT_TRUE(file.redo());
  EXPECT_TRUE(same(notes(), both));
  EXPECT_EQ(lumen::digest(*file.model()), digest);
  EXPECT_EQ(file.journal().back().op, "redo");
}

TEST_F(PressureNotesInCase, AreThereAgainWhenTheCaseIsOpened) {
  file.annotate(told_inputs());
  file.annotate(opened());
  file.apply(ring(10.0, 1.8));
  const PressureNotes before = notes();
  file.copy_to(folder / "b.ostia");
  for (const OpenMode mode : {OpenMode::read_only, OpenMode::read_write}) {
    CaseFile again = CaseFile::open(folder / "b.ostia", mode);
    EXPECT_TRUE(same(again.annotations()->pressure, before));
    EXPECT_TRUE(replay(again).same()) << "a replay leaves them out";
  }
  CaseFile again = CaseFile::open(folder / "b.ostia");
  ASSERT_TRUE(again.undo());
  ASSERT_TRUE(again.undo());
  EXPECT_THAT(again.annotations()->pressure.what_ifs, IsEmpty());
  ASSERT_TRUE(again.go_to_step(1));
  EXPECT_THAT(again.annotations()->pressure.inputs, IsEmpty());
  ASSERT_TRUE(again.go_to_step(3));
  EXPECT_TRUE(same(again.annotations()->pressure, before));
}

TEST_F(PressureNotesInCase, AFewerStretchesLeaveNoRowBehind) {
  file.annotate(opened());
  SetWhatIfs one = opened();
  one.what_ifs.erase(one.what_ifs.begin());
  file.annotate(one);
  file.annotate(SetPressureInputs{{{"venous_mmhg", 0.0}}});
  file.annotate(SetPressureInputs{});
  EXPECT_THAT(notes().inputs, IsEmpty());
  file.copy_to(folder / "b.ostia");
  EXPECT_EQ(CaseFile::open(folder / "b.ostia").annotations()->pressure.what_ifs, one.what_ifs);
}

TEST_F(PressureNotesInCase, NothingNewIsNoStep) {
  file.annotate(opened());
  EXPECT_TRUE(file.annotate(opened()).empty());
  EXPECT_THAT(file.journal(), SizeIs(2));
}

TEST_F(PressureNotesInCase, WhatIsNoneIsRefusedInASentence) {
  const auto stretch = [&](double from, double to, WhatIfKind kind, double percent, std::int32_t vessel) {
    return refusal(SetWhatIfs{{{vessel, from, to, kind, percent}}});
  };
  EXPECT_THAT(stretch(5, 5, WhatIfKind::open, 0, tube_vessel), HasSubstr("is none"));
  EXPECT_THAT(stretch(-1, 5, WhatIfKind::open, 0, tube_vessel), HasSubstr("is none"));
  EXPECT_THAT(stretch(1, HUGE_VAL, WhatIfKind::open, 0, tube_vessel), HasSubstr("not a finite number"));
  EXPECT_THAT(stretch(1, 5, WhatIfKind::open, 95, tube_vessel), HasSubstr("0 to 90"));
  EXPECT_THAT(stretch(1, 5, WhatIfKind::narrow, 0, tube_vessel), HasSubstr("1 to 99"));
  EXPECT_THAT(stretch(1, 5, WhatIfKind::narrow, 100, tube_vessel), HasSubstr("1 to 99"));
  EXPECT_THAT(stretch(1, 5, WhatIfKind::open, 0, 77), HasSubstr("vessel 77"));
  EXPECT_THAT(stretch(40, 50, WhatIfKind::open, 0, tube_vessel), HasSubstr("of a vessel of 30"));
  EXPECT_THAT(refusal(SetPressureInputs{{{"systolic_mmhg", 400.0}}}), HasSubstr("between 60 and 260 mmHg"));
  EXPECT_THAT(refusal(SetPressureInputs{{{"systolic_mmhg", 70.0}}}), HasSubstr("not below the systolic"));
  EXPECT_THAT(refusal(SetPressureInputs{{{"mood", 1.0}}}), HasSubstr("no input \"mood\""));
  EXPECT_THAT(refusal(SetPressureInputs{{{"lv_mass_g", std::nan("")}}}), HasSubstr("not a finite number"));
  EXPECT_THAT(refusal(SetWhatIfs{std::vector<WhatIf>(101, opened().what_ifs[0])}), HasSubstr("up to 100"));
  EXPECT_THAT(file.journal(), SizeIs(1)) << "nothing of it was kept";
}

TEST_F(PressureNotesInCase, GoWithAVesselThatIsSplit) {
  file.annotate(SetWhatIfs{
      {{tube_vessel, 3.0, 8.0, WhatIfKind::open, 0.0}, {tube_vessel, 20.0, 26.0, WhatIfKind::open, 0.0}}});
  const lumen::EditOutcome outcome = file.apply(lumen::BranchSplit{tube_vessel, 14.0, "distal"});
  ASSERT_THAT(outcome.model.tree.vessels, SizeIs(2));
  ASSERT_THAT(notes().what_ifs, SizeIs(2));
  EXPECT_EQ(notes().what_ifs[0].vessel, tube_vessel);
  EXPECT_EQ(notes().what_ifs[1].vessel, outcome.model.tree.vessels[1].id);
  ASSERT_TRUE(file.undo());
  EXPECT_EQ(notes().what_ifs[1].vessel, tube_vessel);
}

TEST(PressureNotes, GiveConditionsInThePlaceOfUsualOnes) {
  const hemodynamics::Conditions usual, given = conditions_of({told_inputs().inputs, {}});
  EXPECT_EQ(given.systolic_mmhg, 130.0 + 1.0 / 3.0);
  EXPECT_EQ(given.lv_mass_g, 141.7);
  EXPECT_EQ(given.diastolic_mmhg, usual.diastolic_mmhg);
  EXPECT_FALSE(given.rest_flow_ml_min);
}

}  // namespace
}  // namespace ostia::session::testing
