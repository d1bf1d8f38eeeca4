// What a report says of models whose sizes are known beforehand.

#include "ostia/session/case_report.h"

#include "report_cases.h"

#include "ostia/core/error.h"
#include "ostia/core/parallel.h"
#include "ostia/session/edit_json.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>

namespace ostia::session {
namespace {

using namespace testing;
using ::testing::AllOf;
using ::testing::Contains;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::Not;

using std::numbers::pi;

TEST(CaseReport, TellsAHealthyTubesSizes) {
  const CaseReport report = report_of(lumen::model_of_tubes(
      lumen::testing::tree_of(geometry::straight_tube(60.0, 1.5, 0.5).tubes.front().axis, "RCA")));
  EXPECT_THAT(report.stenoses, IsEmpty());
  EXPECT_EQ(to_string(report.category), "N");  // nobody has checked it, and the left arteries are not there
  EXPECT_THAT(report.warnings, ElementsAre(HasSubstr("image was not at hand")));
  ASSERT_EQ(report.segments.size(), 3U);  // proximal, mid and distal
  double length = 0.0, volume = 0.0;
  for (const ReportSegment& segment : report.segments) {
    EXPECT_EQ(segment.vessel_name, "RCA");
    EXPECT_NEAR(segment.mean_diameter_mm.value(), 3.0, 0.03) << segment.label;
    // The caps at the ends are no calibre.
    EXPECT_NEAR(segment.least_diameter_mm.value(), 3.0, 0.06) << segment.label;
    EXPECT_NEAR(segment.least_area_mm2.value(), pi * 2.25, 0.3) << segment.label;
    EXPECT_EQ(segment.worst_stenosis, 0);
    length += segment.to_mm - segment.from_mm;
    volume += segment.volume_mm3.value();
  }
  EXPECT_NEAR(length, 60.0, 1e-9);
  EXPECT_NEAR(volume, pi * 2.25 * 60.0, 0.02 * pi * 2.25 * 60.0);
  EXPECT_THAT(report.segments[0].label, HasSubstr("pRCA"));
}

TEST(CaseReport, FindsAStenosisOfKnownSize) {
  const CaseReport report = checked_report(narrowed_tube("RCA", 60.0, 1.5, 22.0, 0.6));
  ASSERT_EQ(report.stenoses.size(), 1U);
  const ReportStenosis& one = report.stenoses[0];
  EXPECT_EQ(one.number, 1);
  EXPECT_NEAR(one.stenosis.throat_mm, 22.0, 0.6);
  EXPECT_NEAR(one.stenosis.least_diameter_mm, 1.2, 0.08);
  EXPECT_NEAR(one.stenosis.reference_diameter_mm, 3.0, 0.06);
  EXPECT_NEAR(one.stenosis.diameter_percent, 60.0, 3.0);
  EXPECT_NEAR(one.stenosis.area_percent, 84.0, 3.0);
  EXPECT_EQ(one.category, analysis::CadRads::three);
  EXPECT_EQ(to_string(report.category), "3/N");  // there is no left artery
  EXPECT_EQ(one.main_vessel, "RCA");
  EXPECT_THAT(one.segment, HasSubstr("mRCA"));
  for (const ReportSegment& segment : report.segments) {
    const bool mid = segment.label == one.segment;
    EXPECT_EQ(segment.worst_stenosis, mid ? 1 : 0);
    EXPECT_EQ(segment.worst_percent, mid ? one.stenosis.diameter_percent : 0.0);
  }
}

TEST(CaseReport, AStenosisOfASharedStretchIsReportedOnceAndAsTheLeftMains) {
  const CaseReport report = checked_report(narrowed_y(0, 7.0, 0.6));
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_EQ(report.stenoses[0].vessel_name, "LAD");
  EXPECT_EQ(report.stenoses[0].main_vessel, "LM");
  EXPECT_EQ(report.stenoses[0].category, analysis::CadRads::three);
  EXPECT_EQ(report.category.category, analysis::CadRads::four_b);  // left main from 50 %
}

TEST(CaseReport, ABranchsStenosisIsItsOwn) {
  const CaseReport report = checked_report(narrowed_y(2, 12.0, 0.6));
  ASSERT_FALSE(report.stenoses.empty());
  EXPECT_EQ(std::count_if(report.stenoses.begin(), report.stenoses.end(),
                          [](const ReportStenosis& one) { return one.stenosis.diameter_percent > 50.0; }),
            1);
  EXPECT_EQ(report.stenoses.back().vessel_name, "LCX");
  EXPECT_EQ(report.category.category, analysis::CadRads::three);
}

TEST(CaseReport, AThinVesselsStenosisIsListedWithoutASay) {
  const lumen::LumenModel model = narrowed_tube("OM1", 40.0, 0.7, 20.0, 0.28);
  const CaseReport report = checked_report(model);
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_FALSE(report.stenoses[0].graded);
  EXPECT_THAT(report.stenoses[0].not_graded, HasSubstr("thinner than 1.50 mm"));
  EXPECT_EQ(report.stenoses[0].category, analysis::CadRads::three);
  EXPECT_EQ(report.category.category, std::nullopt);
  ReportOptions all;
  all.least_graded_mm = 0.0;
  EXPECT_EQ(checked_report(model, nullptr, all).category.category, analysis::CadRads::three);
}

/// A scan of a tube of 40 mm as `tube_image`, without its edge from 15 mm on: a vein lies all about it.
imaging::ImageVolume drowned_image() {
  imaging::ImageVolume image = walled_image(1.5, 1.5, -90.0);
  for (std::int64_t k = 53; k < image.geometry.size[2]; ++k)
    for (std::int64_t j = 0; j < image.geometry.size[1]; ++j)
      for (std::int64_t i = 0; i < image.geometry.size[0]; ++i) image(i, j, k) = 400;
  return image;
}

TEST(CaseReport, GradesWhatTheImageShows) {
  const imaging::ImageVolume image = walled_image(1.5, 1.5, -90.0);
  const CaseReport report = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), {}, {}, &image);
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_TRUE(report.stenoses[0].graded) << report.stenoses[0].not_graded;
  EXPECT_EQ(report.stenoses[0].evaluable->grade, analysis::Evaluability::evaluable);
  EXPECT_EQ(to_string(report.category), "3/N");
  ASSERT_TRUE(report.quality);
  EXPECT_EQ(report.quality->grade, ScanGrade::good);
  EXPECT_THAT(report.not_judged, ElementsAre(HasSubstr("left coronary artery")));
}

TEST(CaseReport, WhatCannotBeJudgedIsNotGradedUnlessAPersonHasCheckedIt) {
  const imaging::ImageVolume image = drowned_image();
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 26.0, 0.6);
  const CaseReport report = report_of(model, {}, {}, &image);
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_FALSE(report.stenoses[0].graded);
  EXPECT_EQ(report.stenoses[0].category, std::nullopt);
  EXPECT_EQ(report.stenoses[0].evaluable->grade, analysis::Evaluability::not_evaluable);
  EXPECT_THAT(report.stenoses[0].not_graded, HasSubstr("no clear edge"));
  EXPECT_EQ(to_string(report.category), "N");
  EXPECT_THAT(report.not_judged,
              Contains(::testing::ContainsRegex("RCA from 1[45].[0-9] to 40.0 mm: not evaluable")));
  EXPECT_THAT(report.not_judged, Contains(HasSubstr("S1 in ")));
  const CaseReport checked = checked_report(model, &image);
  EXPECT_TRUE(checked.stenoses[0].graded);
  EXPECT_EQ(to_string(checked.category), "3/N");
}

TEST(CaseReport, OfAVesselThatIsHardlyAnArteryNothingIsGradedAndTheArteryIsNamedAsMissing) {
  const imaging::ImageVolume image = walled_image(1.5, 1.5, -90.0);
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  ReportOptions options;
  options.certainty = hardly_an_artery(model, 0.01);
  const CaseReport report = report_of(model, {}, {}, &image, options);
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_EQ(report.stenoses[0].evaluable->grade, analysis::Evaluability::evaluable);
  EXPECT_FALSE(report.stenoses[0].graded);
  EXPECT_THAT(report.stenoses[0].not_graded, HasSubstr("hardly an artery (probability 0.01)"));
  EXPECT_EQ(to_string(report.category), "N");
  EXPECT_THAT(report.not_found,
              Contains("RCA: not found, what was found is hardly an artery (probability of RCA 0.01)"));
  EXPECT_THAT(report_html(report, {}), HasSubstr("RCA: not found"));
  EXPECT_THAT(report_json(report, {}), HasSubstr("\"unlikely\": 0.01"));

  options.certainty = hardly_an_artery(model, 0.4);  // a doubt alone
  EXPECT_EQ(to_string(report_of(model, {}, {}, &image, options).category), "3/N");
  options.certainty = hardly_an_artery(model, 0.01);
  const CaseReport checked = checked_report(model, &image, options);
  EXPECT_EQ(to_string(checked.category), "3/N") << "a person says that it is one";
  EXPECT_THAT(checked.not_found, Not(Contains(HasSubstr("RCA: not found"))));
}

TEST(CaseReport, TheReadersWordHolds) {
  const imaging::ImageVolume image = walled_image(1.5, 1.5, -90.0);
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6);
  Annotations notes;
  notes.marks = {{model.tree.vessels[0].id, true, true, std::nullopt, ""}};
  notes.marks[0].evaluable = {{15.0, 25.0, analysis::Evaluability::not_evaluable, {}, true}};
  const CaseReport against = report_of(model, notes, {}, &image);
  EXPECT_FALSE(against.stenoses[0].graded);
  EXPECT_THAT(against.not_judged,
              Contains(HasSubstr("RCA from 15.0 to 25.0 mm: not evaluable (says the reader)")));
  const imaging::ImageVolume drowned = drowned_image();
  notes.marks[0].checked = false;
  notes.marks[0].evaluable = {{0.0, 40.0, analysis::Evaluability::evaluable, {}, true}};
  EXPECT_TRUE(report_of(model, notes, {}, &drowned).stenoses[0].graded);
  EXPECT_TRUE(report_of(model, notes).stenoses[0].graded);  // no image: the reader has looked at one
}

TEST(CaseReport, WhatTheReaderRejectsIsNotGradedAndWhatIsAcceptedIs) {
  const imaging::ImageVolume image = drowned_image();
  const lumen::LumenModel model = narrowed_tube("RCA", 40.0, 1.5, 26.0, 0.6);
  Annotations notes;
  notes.marks = {{model.tree.vessels[0].id, true, false, std::nullopt, ""}};
  notes.marks[0].lesions = {{24.0, 28.0, LesionState::accepted, "seen on two planes"}};
  const CaseReport accepted = report_of(model, notes, {}, &image);
  const auto narrow = [](const CaseReport& report) -> const ReportStenosis& {
    return *std::find_if(report.stenoses.begin(), report.stenoses.end(),
                         [](const ReportStenosis& one) { return one.narrows; });
  };
  EXPECT_TRUE(narrow(accepted).graded) << narrow(accepted).not_graded;
  EXPECT_EQ(narrow(accepted).comment, "seen on two planes");
  EXPECT_EQ(to_string(accepted.category), "3/N");

  notes.marks[0].checked = true;  // rejected all the same
  notes.marks[0].lesions[0].state = LesionState::rejected;
  const CaseReport rejected = report_of(model, notes, {}, &image);
  EXPECT_FALSE(narrow(rejected).graded);
  EXPECT_EQ(narrow(rejected).category, std::nullopt);
  EXPECT_EQ(narrow(rejected).not_graded, "rejected by the reader");
  EXPECT_THAT(rejected.not_judged, Not(Contains(HasSubstr("rejected"))));
  for (const ReportSegment& segment : rejected.segments)
    EXPECT_NE(segment.worst_stenosis, narrow(rejected).number);
  const std::string label = "S" + std::to_string(narrow(rejected).number);
  EXPECT_THAT(report_html(rejected, {}), HasSubstr(label + ": seen on two planes"));
  EXPECT_THAT(report_html(rejected, {}), HasSubstr("1 rejected by a person"));
  EXPECT_THAT(stenoses_csv(rejected), HasSubstr(",rejected,seen on two planes,no,\r\n"));
  EXPECT_THAT(report_json(rejected, {}), HasSubstr("\"state\": \"rejected\""));
}

TEST(CaseReport, PlaqueWithoutNarrowingIsListedAndOfCategoryOne) {
  const imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const CaseReport report = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5), {}, {}, &image);
  ASSERT_EQ(report.stenoses.size(), 1U);
  EXPECT_FALSE(report.stenoses[0].narrows);
  EXPECT_LT(report.stenoses[0].stenosis.diameter_percent, 5.0);
  EXPECT_EQ(report.stenoses[0].category, analysis::CadRads::one);
  EXPECT_GT(report.vessels[0].plaque->volumes.burden_percent(), 60.0);
  const imaging::ImageVolume healthy = walled_image(1.5, 2.0, 60.0);
  const CaseReport without = report_of(narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5), {}, {}, &healthy);
  EXPECT_TRUE(without.stenoses.empty());
  ASSERT_TRUE(without.vessels[0].plaque);
  EXPECT_EQ(without.vessels[0].plaque->volumes.burden_percent(), 0.0);
}

TEST(CaseReport, AnArteryThatIsMissingIsNamed) {
  EXPECT_THAT(arteries_not_found(named_y()), ElementsAre("RCA: not found"));
  EXPECT_THAT(arteries_not_found(narrowed_tube("RCA", 40.0, 1.5, 20.0, 1.5)),
              ElementsAre("left coronary artery (LM, LAD, LCX): not found"));
  EXPECT_THAT(arteries_not_found(narrowed_tube("D1", 40.0, 1.5, 20.0, 1.5)),  // a branch is not its trunk
              ElementsAre("left coronary artery (LM, LAD, LCX): not found", "RCA: not found"));
}

TEST(CaseReport, TellsWhatNobodyChecked) {
  Annotations notes;
  notes.marks = {{1, true, true, std::nullopt, "seen"}};
  const lumen::LumenModel model = named_y();
  notes.marks[0].vessel = model.tree.vessels[0].id;
  const CaseReport report = report_of(model, notes);
  EXPECT_THAT(report.unchecked(), ElementsAre("LCX"));
  EXPECT_EQ(report.vessels[0].note, "seen");
  for (const ReportSegment& segment : report.segments)
    EXPECT_EQ(segment.checked, segment.vessel_name == "LAD");
}

TEST(CaseReport, WarnsOfAVesselThatIsNoCoronarysName) {
  const CaseReport report = checked_report(narrowed_tube("vessel", 40.0, 1.5, 20.0, 0.6));
  EXPECT_THAT(report.warnings, ::testing::Contains(HasSubstr("no name of a coronary artery")));
  EXPECT_EQ(report.category.category, analysis::CadRads::three);  // its stenosis counts all the same
  EXPECT_THAT(report.not_found, ElementsAre(AllOf(HasSubstr("left coronary artery"), HasSubstr("vessel")),
                                            HasSubstr("RCA: not found")));
}

TEST(CaseReport, MeasuresWhatWasPlacedAndNamesWhatCannotBe) {
  Annotations notes;
  for (const analysis::MeasureKind kind : all_kinds) {
    notes.measurements.push_back(measurement(kind));
    notes.measurements.back().id = notes.next_measurement_id++;
  }
  notes.measurements.push_back(measurement(analysis::MeasureKind::volume, 99));
  notes.measurements.back().id = notes.next_measurement_id++;
  const CaseReport report = report_of(tube_model(), notes);
  ASSERT_EQ(report.measurements.size(), 10U);
  for (const ReportMeasurement& one : report.measurements) {
    SCOPED_TRACE(one.measurement.id);
    if (analysis::is_remark(one.measurement.kind)) {
      EXPECT_TRUE(one.values.empty() && one.problem.empty());
      continue;
    }
    EXPECT_NE(one.values.empty(), one.problem.empty());
  }
  const geometry::Vec3 a(0.1, -1.0 / 3.0, 10.0), b(-0.0, 1.5, 10.0);
  EXPECT_DOUBLE_EQ(report.measurements[0].values.at(0).value, (a - b).norm());
  EXPECT_EQ(report.measurements[0].vessel_name, "");
  EXPECT_EQ(report.measurements[4].vessel_name, "LAD");
  EXPECT_NEAR(report.measurements[5].values.at(0).value, pi * 2.25 * (20.1 - 5.0 - 1.0 / 7.0), 2.5);
  EXPECT_THAT(report.measurements[6].problem, HasSubstr("image was not at hand"));
  EXPECT_THAT(report.measurements[9].problem, HasSubstr("its vessel was deleted"));
  EXPECT_THAT(report.measurements[9].vessel_name, HasSubstr("vessel 99"));

  const imaging::ImageVolume image = tube_image();
  const CaseReport with = report_of(tube_model(), notes, {}, &image);
  EXPECT_FALSE(with.measurements[6].values.empty());
  EXPECT_THAT(with.warnings, IsEmpty());
}

TEST(CaseReport, TheLogIsWhatWasDoneAndNotUndone) {
  const TempFolder folder;
  CaseFile file = CaseFile::create(folder / "a.ostia", tube_model());
  file.apply(ring(12.0, 1.8));
  file.apply(renamed("dropped"));
  file.undo();
  file.apply(renamed("RCA"));
  file.annotate(added(analysis::MeasureKind::stenosis));
  file.annotate(added(analysis::MeasureKind::distance));
  file.annotate(marked("fine"));
  file.apply(drag(20.0, 0.3));
  file.undo();
  const CaseReport report = report_of(*file.model(), *file.annotations(), file.journal());
  std::vector<std::string> words, vessels;
  for (const ReportStep& step : report.steps) words.push_back(step.words), vessels.push_back(step.vessel);
  EXPECT_THAT(words, ElementsAre("case begun", "contour drawn on a cross-section at 12.0 mm",
                                 "vessel renamed: RCA", HasSubstr("measurement added: stenosis"),
                                 HasSubstr("measurement added: distance"), "vessel's mark set: checked"));
  EXPECT_THAT(vessels, ElementsAre("", "RCA", "RCA", "RCA", "", "RCA"));
  EXPECT_EQ(report.steps[2].number, 5);  // 3 and 4 were the name that was dropped, and its undo
}

TEST(CaseReport, HasWordsForEveryCommand) {
  std::vector<JournalEntry> journal;
  for (const lumen::Edit& edit : one_of_each())
    journal.push_back({static_cast<std::int64_t>(journal.size()) + 1,
                       lumen::op_name(edit),
                       to_json(edit),
                       false,
                       false,
                       StepKind::edit,
                       {}});
  for (const AnnotationCommand& command :
       {AnnotationCommand(added(analysis::MeasureKind::angle)),
        AnnotationCommand(MeasureChange{measurement(analysis::MeasureKind::area)}),
        AnnotationCommand(MeasureDelete{3}), AnnotationCommand(marked("")), AnnotationCommand(told_inputs()),
        AnnotationCommand(opened())})
    journal.push_back({static_cast<std::int64_t>(journal.size()) + 1,
                       op_name(command),
                       to_json(command),
                       false,
                       false,
                       StepKind::annotation,
                       {}});
  const CaseReport report = report_of(tube_model(), {}, journal);
  ASSERT_EQ(report.steps.size(), journal.size());
  for (const ReportStep& step : report.steps)
    EXPECT_EQ(step.words.find(step.op), std::string::npos) << step.op;
}

TEST(CaseReport, IsTheSameForAnyNumberOfThreads) {
  const lumen::LumenModel model = named_y();
  const int before = core::max_threads();
  core::set_max_threads(1);
  const std::string one = report_json(report_of(model), {});
  core::set_max_threads(4);
  EXPECT_EQ(report_json(report_of(model), {}), one);
  core::set_max_threads(before);
}

TEST(CaseReport, RefusesOptionsThatMakeNoSense) {
  const auto refused = [](const std::function<void(ReportOptions&)>& spoil) {
    ReportOptions options;
    spoil(options);
    EXPECT_THROW(report_of(tube_model(), {}, {}, nullptr, options), InvalidInput);
  };
  refused([](ReportOptions& o) { o.profile.step_mm = 0.0; });
  refused([](ReportOptions& o) { o.reference.window_mm = 1.0; });
  refused([](ReportOptions& o) { o.stenosis.least_percent = 0.0; });
  refused([](ReportOptions& o) { o.least_graded_mm = -1.0; });
  refused([](ReportOptions& o) { o.picture_percent = 101.0; });
  refused([](ReportOptions& o) { o.theta_deg = std::numeric_limits<double>::infinity(); });
  refused([](ReportOptions& o) { o.window_hu = 0.0; });
}

TEST(CaseReport, CanBeCancelled) {
  const core::TaskContext task;
  const lumen::LumenModel model = tube_model();
  const analysis::SurfaceOfVessel surfaces = solved_surfaces(model);
  const CaseReport report = report_of(model);
  task.cancel();
  EXPECT_THROW(solved_surfaces(model, task), Cancelled);
  EXPECT_THROW(make_case_report(model, surfaces, {}, {}, nullptr, {}, task), Cancelled);
  EXPECT_THROW(key_images(report, model, surfaces, nullptr, task), Cancelled);
}

}  // namespace
}  // namespace ostia::session
