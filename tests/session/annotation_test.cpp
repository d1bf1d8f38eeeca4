#include "ostia/session/annotation.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace ostia::session {
namespace {

using namespace testing;
using analysis::MeasureKind;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;

/// Commands one after another on a tube.
Annotations after(const std::vector<AnnotationCommand>& commands) {
  const lumen::LumenModel model = tube_model();
  Annotations annotations;
  for (const AnnotationCommand& command : commands) annotations = annotated(annotations, command, model);
  return annotations;
}

std::string refusal(const Annotations& before, const AnnotationCommand& command) {
  try {
    annotated(before, command, tube_model());
  } catch (const InvalidInput& e) {
    return e.what();
  }
  return "nothing was thrown";
}

TEST(Annotation, AMeasurementGetsTheNextId) {
  MeasureAdd second = added(MeasureKind::angle);
  second.measurement.id = 77;
  const Annotations annotations = after({added(MeasureKind::distance), second});
  ASSERT_EQ(annotations.measurements.size(), 2U);
  EXPECT_EQ(annotations.measurements[0].id, 1);
  EXPECT_EQ(annotations.measurements[1].id, 2);
  EXPECT_EQ(annotations.measurements[1].kind, MeasureKind::angle);
  EXPECT_EQ(annotations.next_measurement_id, 3);
}

TEST(Annotation, AnIdIsNotUsedAgain) {
  const Annotations annotations =
      after({added(MeasureKind::distance), MeasureDelete{1}, added(MeasureKind::area)});
  ASSERT_EQ(annotations.measurements.size(), 1U);
  EXPECT_EQ(annotations.measurements[0].id, 2);
  EXPECT_EQ(find_measurement(annotations, 1), nullptr);
  EXPECT_NE(find_measurement(annotations, 2), nullptr);
}

TEST(Annotation, AChangeIsTheWholeValue) {
  MeasureChange change{measurement(MeasureKind::angle)};
  change.measurement.id = 1;
  change.measurement.name = "";
  const Annotations annotations = after({added(MeasureKind::distance), added(MeasureKind::area), change});
  EXPECT_TRUE(same(annotations.measurements[0], change.measurement));
  EXPECT_EQ(annotations.measurements[1].kind, MeasureKind::area);
}

TEST(Annotation, AVesselHasOneMark) {
  const Annotations annotations = after({marked("first"), marked("second", false)});
  ASSERT_EQ(annotations.marks.size(), 1U);
  EXPECT_EQ(annotations.marks[0].note, "second");
  EXPECT_FALSE(find_mark(annotations, tube_vessel)->checked);
  EXPECT_EQ(find_mark(annotations, 99), nullptr);
}

TEST(Annotation, ListsAreInOrder) {
  const lumen::LumenModel model = y_model();
  Annotations annotations;
  std::vector<std::int32_t> ids;
  for (const auto& vessel : model.tree.vessels) ids.push_back(vessel.id);
  ASSERT_GE(ids.size(), 2U);
  std::sort(ids.rbegin(), ids.rend());
  for (const std::int32_t id : ids) annotations = annotated(annotations, marked("x", true, id), model);
  for (std::size_t i = 1; i < annotations.marks.size(); ++i)
    EXPECT_LT(annotations.marks[i - 1].vessel, annotations.marks[i].vessel);
  EXPECT_EQ(annotations.marks.size(), ids.size());
}

TEST(Annotation, RefusesWhatIsNotSound) {
  const Annotations one = after({added(MeasureKind::distance)});
  MeasureAdd pointless = added(MeasureKind::distance);
  pointless.measurement.points.pop_back();
  EXPECT_THAT(refusal(one, pointless), HasSubstr("cannot be kept"));
  EXPECT_THAT(refusal(one, MeasureChange{pointless.measurement}), HasSubstr("no measurement 0"));
  pointless.measurement.id = 1;
  EXPECT_THAT(refusal(one, MeasureChange{pointless.measurement}), HasSubstr("cannot be kept"));
  EXPECT_THAT(refusal(one, MeasureDelete{2}), HasSubstr("no measurement 2"));
  EXPECT_THAT(refusal(one, added(MeasureKind::stenosis, 99)), HasSubstr("vessel 99"));
  EXPECT_THAT(refusal(one, added(MeasureKind::volume, -1)), HasSubstr("vessel -1"));
  EXPECT_THAT(refusal(one, marked("x", true, 99)), HasSubstr("vessel 99"));
  MarkVessel glowing = marked("x");
  glowing.mark.color = {0.0, 1.01, 0.0};
  EXPECT_THAT(refusal(one, glowing), HasSubstr("0 to 1"));
  glowing.mark.color = {0.0, std::numeric_limits<double>::quiet_NaN(), 0.0};
  EXPECT_THAT(refusal(one, glowing), HasSubstr("finite"));
  EXPECT_THAT(refusal(one, marked("\xff")), HasSubstr("UTF-8"));
  MeasureAdd endless = added(MeasureKind::ring_hu);
  endless.measurement.outer_mm = std::numeric_limits<double>::infinity();
  EXPECT_THAT(refusal(one, endless), HasSubstr("finite"));
  Annotations full = one;
  full.next_measurement_id = std::numeric_limits<std::int32_t>::max();
  EXPECT_THAT(refusal(full, added(MeasureKind::distance)), HasSubstr("no ids left"));
}

TEST(Annotation, ChangesNameWhatCameWentOrChanged) {
  const Annotations before =
      after({added(MeasureKind::distance), added(MeasureKind::area), added(MeasureKind::angle)});
  const lumen::LumenModel model = tube_model();
  Annotations now = annotated(before, MeasureDelete{1}, model);
  now = annotated(now, added(MeasureKind::volume), model);
  MeasureChange change{before.measurements[2]};
  change.measurement.name = "other";
  now = annotated(now, change, model);
  now = annotated(now, marked("x"), model);
  EXPECT_THAT(changes_between(before, now).measurements, ElementsAre(1, 3, 4));
  EXPECT_THAT(changes_between(now, before).measurements, ElementsAre(1, 3, 4));
  EXPECT_THAT(changes_between(before, now).marks, ElementsAre(tube_vessel));
  EXPECT_TRUE(changes_between(now, now).empty());
}

TEST(Annotation, EveryFieldCounts) {
  const analysis::Measurement whole = measurement(MeasureKind::stenosis);
  std::vector<analysis::Measurement> others(9, whole);
  others[0].id = 5, others[1].kind = MeasureKind::volume, others[2].name = "",
  others[3].points.emplace_back(0, 0, 0);
  others[4].vessel = 9, others[5].from_mm += 1e-12, others[6].to_mm += 1, others[7].inner_mm = -0.0,
  others[8].outer_mm = 9;
  for (const auto& other : others) EXPECT_FALSE(same(whole, other));
  EXPECT_TRUE(same(whole, whole));
  const VesselMark mark = marked("x").mark;
  std::vector<VesselMark> marks(6, mark);
  marks[0].vessel = 9, marks[1].visible = !mark.visible, marks[2].checked = !mark.checked,
  marks[3].color.reset();
  marks[4].color->at(1) = 0.5, marks[5].note = "y";
  for (const auto& other : marks) EXPECT_FALSE(same(mark, other));
  EXPECT_TRUE(same(mark, mark));
}

TEST(Annotation, WhatLostItsVesselIsKeptAndReported) {
  const lumen::LumenModel model = y_model();
  const std::int32_t vessel = model.vessels.back()->vessel;
  Annotations annotations;
  for (const MeasureKind kind : all_kinds) annotations = annotated(annotations, added(kind, vessel), model);
  annotations = annotated(annotations, marked("gone soon", true, vessel), model);
  EXPECT_THAT(find_orphans(annotations, model).measurements, IsEmpty());
  const lumen::LumenModel without = lumen::apply(model, lumen::BranchDelete{vessel}).model;
  const Orphans orphans = find_orphans(annotations, without);
  EXPECT_THAT(orphans.measurements, ElementsAre(4, 5, 6, 7));  // diameter, stenosis, volume, ring_hu
  EXPECT_THAT(orphans.marks, ElementsAre(vessel));
  // They may be renamed and marked, but no other may go there.
  MeasureChange renamed{annotations.measurements[4]};
  renamed.measurement.name = "of the deleted branch";
  EXPECT_NO_THROW(annotated(annotations, renamed, without));
  EXPECT_NO_THROW(annotated(annotations, marked("still", false, vessel), without));
  EXPECT_THROW(annotated(annotations, added(MeasureKind::volume, vessel), without), InvalidInput);
  MeasureChange retargeted{annotations.measurements[0]};
  retargeted.measurement = measurement(MeasureKind::volume, vessel);
  retargeted.measurement.id = 1;
  EXPECT_THROW(annotated(annotations, retargeted, without), InvalidInput);
}

std::vector<std::string> shown(const VesselMark& mark) {
  std::vector<std::string> out;
  for (const analysis::EvaluableStretch& one : mark.evaluable)
    out.push_back(core::trimmed_text(one.from_mm, 3) + "-" + core::trimmed_text(one.to_mm, 3) + " " +
                  analysis::to_string(one.grade));
  return out;
}

TEST(ReadersWord, IsPutOverWhatWasSaidBefore) {
  using analysis::Evaluability;
  VesselMark mark;
  mark = with_evaluability(mark, 2.0, 10.0, Evaluability::limited);
  mark = with_evaluability(mark, 4.0, 6.0, Evaluability::not_evaluable);
  EXPECT_THAT(shown(mark), ElementsAre("2-4 limited", "4-6 not evaluable", "6-10 limited"));
  EXPECT_THAT(shown(with_evaluability(mark, 4.0, 6.0, Evaluability::limited)), ElementsAre("2-10 limited"));
  EXPECT_THAT(shown(with_evaluability(mark, 3.0, 8.0, std::nullopt)),
              ElementsAre("2-3 limited", "8-10 limited"));
  EXPECT_THAT(shown(with_evaluability(mark, 0.0, 99.0, std::nullopt)), IsEmpty());
}

std::vector<std::string> said_of(const VesselMark& mark) {
  std::vector<std::string> out;
  for (const LesionWord& one : mark.lesions)
    out.push_back(core::trimmed_text(one.from_mm, 3) + "-" + core::trimmed_text(one.to_mm, 3) + " " +
                  to_string(one.state) + " " + one.comment);
  return out;
}

TEST(ReadersWord, OnALesionFollowsItsStretch) {
  VesselMark mark;
  mark = with_lesion(mark, {20.0, 26.0, LesionState::rejected, "a branch"});
  mark = with_lesion(mark, {4.0, 10.0, LesionState::accepted, ""});
  EXPECT_THAT(said_of(mark), ElementsAre("4-10 accepted ", "20-26 rejected a branch"));
  // Found anew a little elsewhere, it is the same lesion; what shares little with it is not.
  ASSERT_NE(word_on(&mark, 5.0, 12.0), nullptr);
  EXPECT_EQ(word_on(&mark, 5.0, 12.0)->state, LesionState::accepted);
  EXPECT_EQ(word_on(&mark, 9.0, 14.0), nullptr);
  EXPECT_EQ(word_on(nullptr, 5.0, 12.0), nullptr);
  mark = with_lesion(mark, {5.0, 12.0, LesionState::rejected, "no edge"});
  EXPECT_THAT(said_of(mark), ElementsAre("5-12 rejected no edge", "20-26 rejected a branch"));
  mark = with_lesion(mark, {20.5, 26.0, LesionState::open, "look again"});
  EXPECT_THAT(said_of(mark), ElementsAre("5-12 rejected no edge", "20.5-26 open look again"));
  mark = with_lesion(mark, {5.0, 12.0, LesionState::open, ""});
  mark = with_lesion(mark, {20.5, 26.0, LesionState::open, ""});
  EXPECT_THAT(said_of(mark), IsEmpty());
}

TEST(ReadersWord, OnLesionsIsRefusedWhereItIsNoStretchOrOutOfOrder) {
  const lumen::LumenModel model = tube_model();
  MarkVessel said = marked("");
  for (const std::vector<LesionWord>& bad :
       {std::vector<LesionWord>{{5.0, 5.0, LesionState::open, "x"}},
        {{-1.0, 5.0, LesionState::open, "x"}},
        {{6.0, 9.0, LesionState::open, "x"}, {2.0, 4.0, LesionState::open, "x"}},
        {{2.0, 4.0, LesionState::open, "x"}, {2.0, 4.0, LesionState::accepted, "y"}},
        {{2.0, std::numeric_limits<double>::infinity(), LesionState::open, "x"}}}) {
    said.mark.lesions = bad;
    EXPECT_THROW(annotated({}, said, model), InvalidInput);
  }
}

TEST(ReadersWord, OnLesionsGoesWithTheVesselThatIsSplitOrJoined) {
  const lumen::LumenModel whole = tube_model();
  MarkVessel said = marked("");
  said.mark.lesions = {{2.0, 6.0, LesionState::accepted, "first"}, {12.0, 16.0, LesionState::rejected, ""}};
  const Annotations before = annotated({}, said, whole);
  const lumen::Edit split = lumen::BranchSplit{tube_vessel, 10.0, ""};
  const lumen::LumenModel parts = lumen::apply(whole, split).model;
  const Annotations after_split = following(before, split, whole, parts);
  ASSERT_EQ(after_split.marks.size(), 2U);
  EXPECT_THAT(said_of(after_split.marks[0]), ElementsAre("2-6 accepted first"));
  EXPECT_THAT(said_of(after_split.marks[1]), ElementsAre("12-16 rejected "));
  const lumen::Edit merge = lumen::BranchMerge{after_split.marks[1].vessel};
  const Annotations joined = following(after_split, merge, parts, lumen::apply(parts, merge).model);
  EXPECT_THAT(said_of(*find_mark(joined, tube_vessel)), ElementsAre("2-6 accepted first", "12-16 rejected "));
}

TEST(ReadersWord, GoesWithTheVesselThatIsSplitCutOrJoined) {
  const lumen::LumenModel whole = tube_model();
  MarkVessel said = marked("");
  said.mark.evaluable = {{4.0, 12.0, analysis::Evaluability::limited, {}, true}};
  const Annotations before = annotated({}, said, whole);
  const lumen::Edit split = lumen::BranchSplit{tube_vessel, 10.0, ""};
  const lumen::LumenModel parts = lumen::apply(whole, split).model;
  const Annotations after_split = following(before, split, whole, parts);
  ASSERT_EQ(after_split.marks.size(), 2U);
  EXPECT_THAT(shown(*find_mark(after_split, tube_vessel)), ElementsAre("4-10 limited"));
  const std::int32_t made =
      after_split.marks[0].vessel == tube_vessel ? after_split.marks[1].vessel : after_split.marks[0].vessel;
  EXPECT_THAT(shown(*find_mark(after_split, made)), ElementsAre("10-12 limited"));

  const lumen::Edit merge = lumen::BranchMerge{made};
  const Annotations after_merge = following(after_split, merge, parts, lumen::apply(parts, merge).model);
  EXPECT_THAT(shown(*find_mark(after_merge, tube_vessel)), ElementsAre("4-12 limited"));

  const lumen::Edit cut = lumen::BranchCut{tube_vessel, 10.0, {}};
  const lumen::LumenModel pieces = lumen::apply(whole, cut).model;
  const Annotations after_cut = following(before, cut, whole, pieces);
  ASSERT_EQ(after_cut.marks.size(), 2U);
  const VesselMark& distal =
      after_cut.marks[0].vessel == tube_vessel ? after_cut.marks[1] : after_cut.marks[0];
  ASSERT_EQ(distal.evaluable.size(), 1U);  // the piece has a beginning of its own
  EXPECT_LT(distal.evaluable[0].from_mm, 0.5);
  EXPECT_NEAR(distal.evaluable[0].to_mm - distal.evaluable[0].from_mm, 2.0, 0.5);
}

TEST(ReadersWord, StretchesThatAreNoneAreRefused) {
  const auto with = [](double from_mm, double to_mm) {
    MarkVessel said = marked("");
    said.mark.evaluable = {{1.0, 2.0, analysis::Evaluability::limited, {}, true},
                           {from_mm, to_mm, analysis::Evaluability::limited, {}, true}};
    return refusal({}, said);
  };
  EXPECT_EQ(with(2.0, 3.0), "nothing was thrown");
  for (const auto& [from, to] : {std::pair{1.5, 3.0}, {4.0, 4.0}, {-1.0, 3.0}})
    EXPECT_THAT(with(from, to), HasSubstr("is none, or overlaps"));
  MarkVessel negative = marked("");
  negative.mark.evaluable = {{-1.0, 2.0, analysis::Evaluability::limited, {}, true}};
  EXPECT_THAT(refusal({}, negative), HasSubstr("is none"));
}

TEST(Annotation, OpsHaveNames) {
  EXPECT_EQ(op_name(MeasureAdd{}), "measure.add");
  EXPECT_EQ(op_name(MeasureChange{}), "measure.change");
  EXPECT_EQ(op_name(MeasureDelete{}), "measure.delete");
  EXPECT_EQ(op_name(MarkVessel{}), "vessel.mark");
  EXPECT_EQ(op_name(SetPressureInputs{}), "pressure.inputs");
  EXPECT_EQ(op_name(SetWhatIfs{}), "pressure.what_if");
  EXPECT_EQ(op_name(SetReportImpression{}), "report.impression");
  EXPECT_EQ(op_name(SetReportModifiers{}), "report.modifiers");
  EXPECT_EQ(op_name(SetPlaqueFeatures{}), "report.features");
  EXPECT_EQ(op_name(SignReport{}), "report.sign");
  EXPECT_EQ(op_name(SetCalciumPlaces{}), "calcium.places");
  EXPECT_TRUE(is_annotation_op("vessel.mark"));
  EXPECT_TRUE(is_annotation_op("pressure.what_if"));
  EXPECT_FALSE(is_annotation_op("vessel.rename"));
}

}  // namespace
}  // namespace ostia::session
