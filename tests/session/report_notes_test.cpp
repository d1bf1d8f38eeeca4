// What a case keeps of its report: steps that are undone, redone, stored and opened; what is refused.

#include "ostia/session/report_notes.h"

#include "case_tools.h"

#include "ostia/core/error.h"
#include "ostia/session/replay.h"
#include "ostia/session/report_digest.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace ostia::session::testing {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

struct ReportNotesInCase : ::testing::Test {
  TempFolder folder;
  fs::path path = folder / "a.ostia";
  CaseFile file = CaseFile::create(path, tube_model());
  const ReportNotes& notes() { return file.annotations()->report; }
  std::string refusal(const AnnotationCommand& command) {
    try {
      file.annotate(command);
    } catch (const InvalidInput& error) {
      return error.what();
    }
    return "nothing was refused";
  }
};

TEST_F(ReportNotesInCase, AreStepsThatAreUndoneAndRedone) {
  const AnnotationChange change = file.annotate(written());
  EXPECT_TRUE(change.report);
  EXPECT_FALSE(change.pressure);
  file.annotate(told_modifiers());
  file.annotate(told_features());
  file.annotate(signing());
  const ReportNotes all = notes();
  EXPECT_EQ(all.impression, written().text);
  EXPECT_EQ(all.modifiers, told_modifiers().modifiers);
  EXPECT_EQ(all.features, told_features().features);
  ASSERT_THAT(all.versions, SizeIs(1));
  EXPECT_EQ(all.versions[0], signing().version);
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(file.undo());
  EXPECT_EQ(notes(), ReportNotes{});
  for (int i = 0; i < 4; ++i) ASSERT_TRUE(file.redo());
  EXPECT_EQ(notes(), all);
}

TEST_F(ReportNotesInCase, AreThereAgainWhenTheCaseIsOpened) {
  file.annotate(written());
  file.annotate(told_modifiers());
  file.annotate(told_features());
  file.annotate(signing());
  file.annotate(written(""));
  file.annotate(signing("the impression was taken out"));
  const ReportNotes before = notes();
  file.copy_to(folder / "b.ostia");
  for (const OpenMode mode : {OpenMode::read_only, OpenMode::read_write}) {
    CaseFile again = CaseFile::open(folder / "b.ostia", mode);
    EXPECT_EQ(again.annotations()->report, before);
    EXPECT_TRUE(replay(again).same());
  }
  CaseFile again = CaseFile::open(folder / "b.ostia");
  ASSERT_TRUE(again.go_to_step(2));
  EXPECT_EQ(again.annotations()->report.impression, written().text);
  EXPECT_THAT(again.annotations()->report.versions, IsEmpty());
}

TEST_F(ReportNotesInCase, WhatIsNoneIsRefusedInASentence) {
  EXPECT_THAT(refusal(written(std::string(20001, 'x'))), HasSubstr("up to 20000"));
  SetReportModifiers modifiers = told_modifiers();
  modifiers.modifiers.agatston = -1.0;
  EXPECT_THAT(refusal(modifiers), HasSubstr("0 to 20000"));
  modifiers = told_modifiers();
  modifiers.modifiers.exception = "two\nlines";
  EXPECT_THAT(refusal(modifiers), HasSubstr("one line"));
  SetPlaqueFeatures features = told_features(77);
  EXPECT_THAT(refusal(features), HasSubstr("vessel 77"));
  features = told_features();
  features.features[0].to_mm = 1.0;
  EXPECT_THAT(refusal(features), HasSubstr("no stretch"));
  for (const char* date : {"", "2026-3-1", "2026-13-01", "01.03.2026", "2026-00-10", "2026-01-32"}) {
    SignReport one = signing();
    one.version.date = date;
    EXPECT_THAT(refusal(one), HasSubstr("give a date")) << date;
  }
  SignReport nobody = signing();
  nobody.version.signer.clear();
  EXPECT_THAT(refusal(nobody), HasSubstr("give a name"));
  SignReport of_nothing = signing();
  of_nothing.version.digest = "abc";
  EXPECT_THAT(refusal(of_nothing), HasSubstr("SHA-256"));
  file.annotate(signing());
  EXPECT_THAT(refusal(signing()), HasSubstr("version 2 of the report does not say what changed"));
  EXPECT_THAT(file.journal(), SizeIs(2)) << "nothing else was kept";
}

TEST_F(ReportNotesInCase, WordsOnPlaqueGoWithAVesselThatIsSplit) {
  file.annotate(SetPlaqueFeatures{
      {{tube_vessel, 3.0, 8.0, analysis::PlaqueFeature::napkin_ring, LesionState::accepted},
       {tube_vessel, 20.0, 26.0, analysis::PlaqueFeature::napkin_ring, LesionState::rejected}}});
  const lumen::EditOutcome outcome = file.apply(lumen::BranchSplit{tube_vessel, 14.0, "distal"});
  ASSERT_THAT(notes().features, SizeIs(2));
  EXPECT_EQ(notes().features[0].vessel, tube_vessel);
  EXPECT_EQ(notes().features[1].vessel, outcome.model.tree.vessels[1].id);
  ASSERT_TRUE(file.undo());
  EXPECT_EQ(notes().features[1].vessel, tube_vessel);
}

TEST(ReportNotes, AWordIsOnTheLesionThatSharesMostWithIt) {
  using analysis::PlaqueFeature;
  ReportNotes notes;
  notes.features = with_feature({}, {4, 5.0, 10.0, PlaqueFeature::napkin_ring, LesionState::accepted});
  EXPECT_EQ(word_on(notes, 4, 5.5, 11.0, PlaqueFeature::napkin_ring), LesionState::accepted);
  EXPECT_EQ(word_on(notes, 4, 5.5, 11.0, PlaqueFeature::spotty_calcium), LesionState::open);
  EXPECT_EQ(word_on(notes, 5, 5.5, 11.0, PlaqueFeature::napkin_ring), LesionState::open);
  EXPECT_EQ(word_on(notes, 4, 9.0, 20.0, PlaqueFeature::napkin_ring), LesionState::open);
  notes.features =
      with_feature(notes.features, {4, 5.5, 11.0, PlaqueFeature::napkin_ring, LesionState::rejected});
  ASSERT_THAT(notes.features, SizeIs(1));
  EXPECT_EQ(notes.features[0].state, LesionState::rejected);
  notes.features =
      with_feature(notes.features, {4, 5.0, 10.0, PlaqueFeature::napkin_ring, LesionState::open});
  EXPECT_THAT(notes.features, IsEmpty());
}

TEST_F(ReportNotesInCase, ASignatureIsForTheContentAlone) {
  const auto digest = [&] { return report_content_digest(*file.model(), *file.annotations()); };
  const std::string first = digest();
  file.annotate(signing());
  EXPECT_EQ(digest(), first) << "who signed is not what was signed";
  MarkVessel hidden{{tube_vessel, true, false, std::nullopt, ""}};
  file.annotate(hidden);
  const std::string marked_one = digest();
  hidden.mark.visible = false;
  hidden.mark.color = std::array{0.1, 0.2, 0.3};
  file.annotate(hidden);
  EXPECT_EQ(digest(), marked_one) << "how a vessel is shown is not signed";
  for (const AnnotationCommand& step :
       {AnnotationCommand(written()), AnnotationCommand(told_modifiers()), AnnotationCommand(told_features()),
        AnnotationCommand(added(analysis::MeasureKind::distance))}) {
    const std::string before = digest();
    file.annotate(step);
    EXPECT_NE(digest(), before) << op_name(step);
  }
  const std::string before = digest();
  file.apply(ring(10.0, 1.8));
  EXPECT_NE(digest(), before);
}

}  // namespace
}  // namespace ostia::session::testing
