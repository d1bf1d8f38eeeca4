// The lesions of the table: found with their plaque, judged by the reader, found anew after an edit.

#include "ostia/session/lesion_board.h"

#include "report_cases.h"

#include "ostia/session/doubts.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <filesystem>

namespace ostia::session {
namespace {

using namespace testing;

/// A tube narrowed to 40 %, in an image with plaque all along.
struct LesionTable : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  EvaluabilityBoard evaluability{bench};
  LesionBoard board{bench, evaluability};
  imaging::ImageVolume image = walled_image(1.5, 2.6, 60.0);
  const ImageReference reference_{std::string(64, 'a'), "case-aaaa"};

  void open(bool with_image = true) {
    bench.set_session(Session(
        CaseFile::create(folder / "a.ostia", narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), reference_)));
    if (with_image) bench.set_image({std::make_shared<const imaging::ImageVolume>(image), reference_});
  }
  std::int32_t vessel() { return bench.model()->tree.vessels.front().id; }
  void find_all() {
    while (const auto work = board.work()) ASSERT_TRUE(board.take(*work, work->found()));
  }
};

TEST_F(LesionTable, HasNothingBeforeAVesselIsMeasured) {
  EXPECT_TRUE(board.rows().empty());
  open(false);
  EXPECT_TRUE(board.rows().empty());
  EXPECT_FALSE(board.work()) << "there is no image";
  EXPECT_EQ(board.missing(), 0);
  bench.profile(vessel());
  const auto& rows = board.rows();
  ASSERT_EQ(rows.size(), 1U);
  EXPECT_EQ(rows[0].number, 1);
  EXPECT_EQ(rows[0].vessel_name, "RCA");
  EXPECT_NEAR(rows[0].lesion.stenosis.diameter_percent, 60.0, 2.0);
  EXPECT_FALSE(rows[0].segment.empty());
  EXPECT_FALSE(rows[0].lesion.plaque);
  EXPECT_FALSE(rows[0].evaluable);
}

TEST_F(LesionTable, IsThatOfTheReport) {
  open();
  bench.profile(vessel());
  EXPECT_EQ(board.missing(), 1);
  find_all();
  EXPECT_EQ(board.missing(), 0);
  VesselMark mark;
  mark.vessel = vessel();
  bench.annotate(MarkVessel{with_lesion(mark, {18.0, 22.0, LesionState::accepted, "tight"})});
  const CaseReport report = report_of(*bench.model(), *bench.session().file().annotations(), {}, &image);
  const auto& rows = board.rows();
  ASSERT_EQ(rows.size(), report.stenoses.size());
  ASSERT_EQ(rows.size(), 3U);
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ReportStenosis& told = report.stenoses[i];
    EXPECT_EQ(rows[i].number, told.number);
    EXPECT_EQ(rows[i].segment, told.segment);
    EXPECT_EQ(rows[i].lesion.narrows, told.narrows);
    EXPECT_EQ(rows[i].state, told.state);
    EXPECT_EQ(rows[i].comment, told.comment);
    EXPECT_NEAR(rows[i].lesion.stenosis.diameter_percent, told.stenosis.diameter_percent, 0.5);
    ASSERT_TRUE(rows[i].lesion.plaque && told.plaque);
    EXPECT_NEAR(rows[i].lesion.plaque->plaque_mm3(), told.plaque->volumes.plaque_mm3(), 2.0);
  }
  EXPECT_EQ(rows[1].state, LesionState::accepted);
}

TEST(LesionGrade, StandsWhereAPersonOrTheImageBearsIt) {
  using analysis::Evaluability;
  using analysis::EvaluableStretch;
  const auto stretch = [](Evaluability grade, bool by_person) {
    return std::optional(EvaluableStretch{0.0, 10.0, grade, {}, by_person});
  };
  const auto open = LesionState::open;
  EXPECT_EQ(grade_bar(open, false, std::nullopt), GradeBar::image_unknown);
  EXPECT_EQ(grade_bar(open, true, std::nullopt), GradeBar::none);
  EXPECT_EQ(grade_bar(open, false, stretch(Evaluability::evaluable, false)), GradeBar::none);
  EXPECT_EQ(grade_bar(open, false, stretch(Evaluability::limited, false)), GradeBar::limited);
  EXPECT_EQ(grade_bar(open, true, stretch(Evaluability::limited, false)), GradeBar::none);
  EXPECT_EQ(grade_bar(open, false, stretch(Evaluability::limited, true)), GradeBar::none);
  EXPECT_EQ(grade_bar(open, false, stretch(Evaluability::not_evaluable, false)), GradeBar::not_evaluable);
  EXPECT_EQ(grade_bar(open, true, stretch(Evaluability::not_evaluable, false)), GradeBar::none);
  EXPECT_EQ(grade_bar(open, true, stretch(Evaluability::not_evaluable, true)),
            GradeBar::not_evaluable_by_reader);
  for (const bool checked : {false, true})
    for (const Evaluability grade :
         {Evaluability::evaluable, Evaluability::limited, Evaluability::not_evaluable}) {
      EXPECT_EQ(grade_bar(LesionState::accepted, checked, stretch(grade, false)), GradeBar::none);
      EXPECT_EQ(grade_bar(LesionState::rejected, checked, stretch(grade, false)), GradeBar::rejected);
    }
}

TEST_F(LesionTable, HasAGradeWhereTheReportHasOneAndNowhereElse) {
  // Noise makes the image less than evaluable; half of a narrowing is what it takes for a category.
  for (const int noise_hu : {0, 60, 110, 400}) {
    std::uint32_t state = 7;
    for (std::int16_t& voxel : image.voxels) {
      state = state * 1664525U + 1013904223U;
      voxel = static_cast<std::int16_t>(voxel + static_cast<int>((state >> 8U) % (2U * noise_hu + 1U)) -
                                        noise_hu);
    }
    bench.close_case();
    bench.close_image();
    std::filesystem::remove(folder / "a.ostia");
    open();
    bench.profile(vessel());
    find_all();
    while (const auto work = evaluability.work()) ASSERT_TRUE(evaluability.take(*work, work->found()));
    for (const bool checked : {false, true}) {
      VesselMark mark = mark_or_new(*bench.session().file().annotations(), vessel());
      mark.checked = checked;
      bench.annotate(MarkVessel{mark});
      const CaseReport report = report_of(*bench.model(), *bench.session().file().annotations(), {}, &image);
      const auto& rows = board.rows();
      ASSERT_EQ(rows.size(), report.stenoses.size()) << noise_hu;
      ASSERT_FALSE(rows.empty());
      for (std::size_t i = 0; i < rows.size(); ++i)
        EXPECT_EQ(rows[i].bar() == GradeBar::none, report.stenoses[i].category.has_value())
            << noise_hu << " HU, lesion " << i;
    }
  }
}

TEST_F(LesionTable, TheReadersWordIsAStepThatIsStoredAndUndone) {
  open(false);
  bench.profile(vessel());
  int told = 0;
  const auto kept = board.changed.observe([&] { ++told; });
  board.say(LesionRow(board.rows()[0]), LesionState::rejected, "a branch's mouth");
  EXPECT_GT(told, 0);
  EXPECT_EQ(board.rows()[0].state, LesionState::rejected);
  EXPECT_EQ(board.rows()[0].comment, "a branch's mouth");
  board.say(LesionRow(board.rows()[0]), LesionState::accepted, "a branch's mouth");
  EXPECT_EQ(find_mark(*bench.session().file().annotations(), vessel())->lesions.size(), 1U);
  ASSERT_TRUE(bench.undo());
  EXPECT_EQ(board.rows()[0].state, LesionState::rejected);
  ASSERT_TRUE(bench.undo());
  EXPECT_EQ(board.rows()[0].state, LesionState::open);
  ASSERT_TRUE(bench.redo());
  const std::int32_t id = vessel();
  bench.close_case();
  EXPECT_TRUE(board.rows().empty());
  const auto notes = CaseFile::open(folder / "a.ostia", OpenMode::read_only).annotations();
  ASSERT_EQ(find_mark(*notes, id)->lesions.size(), 1U);
  EXPECT_EQ(find_mark(*notes, id)->lesions[0].comment, "a branch's mouth");
}

TEST_F(LesionTable, AWordHoldsAfterAnEditAndThePlaqueIsFoundAnew) {
  open();
  bench.profile(vessel());
  find_all();
  const auto narrow = [&]() -> LesionRow {
    const auto& rows = board.rows();
    return *std::find_if(rows.begin(), rows.end(), [](const LesionRow& one) { return one.lesion.narrows; });
  };
  board.say(narrow(), LesionState::accepted, "");
  const double before = narrow().lesion.stenosis.diameter_percent;
  for (const double s : {19.0, 20.0, 21.0}) bench.edit(ring(s, 0.9));
  EXPECT_EQ(board.missing(), 1) << "the wall moved";
  EXPECT_LT(narrow().lesion.stenosis.diameter_percent, before - 5.0);
  EXPECT_EQ(narrow().state, LesionState::accepted);
  EXPECT_TRUE(narrow().lesion.plaque) << "the former one stands until it is found anew";
  const auto work = board.work();
  ASSERT_TRUE(work);
  bench.edit(ring(12.0, 1.5));
  EXPECT_FALSE(board.take(*work, work->found())) << "of another model";
  find_all();
  EXPECT_EQ(board.missing(), 0);
}

TEST_F(LesionTable, OfOneVesselAllStandsWhileAnotherGoesAndComesBack) {
  bench.set_session(Session(CaseFile::create(folder / "a.ostia", narrowed_y(1, 12.0, 0.6), reference_)));
  bench.set_image({std::make_shared<const imaging::ImageVolume>(image), reference_});
  const std::int32_t lad = vessel(), lcx = bench.model()->tree.vessels.back().id;
  for (const std::int32_t one : {lad, lcx}) bench.profile(one);
  // What is found of their walls is no matter here: that it is kept is.
  while (const auto work = board.work()) {
    ASSERT_TRUE(board.take(*work, analysis::PlaqueProfile()));
  }
  while (const auto work = evaluability.work()) {
    EvaluabilityWork::Found found;
    found.vessel.stretches = {{0.0, 40.0, analysis::Evaluability::limited, {}, false}};
    ASSERT_TRUE(evaluability.take(*work, found));
  }
  const auto narrow = [&]() -> std::optional<LesionRow> {
    for (const LesionRow& row : board.rows())
      if (row.vessel == lad && row.lesion.narrows) return row;
    return std::nullopt;
  };
  ASSERT_TRUE(narrow());
  board.say(*narrow(), LesionState::accepted, "tight");
  evaluability.judge(lad, 0.0, 10.0, analysis::Evaluability::evaluable);
  const auto stands = [&](const char* when) {
    const std::optional<LesionRow> row = narrow();
    ASSERT_TRUE(row) << when;
    EXPECT_EQ(row->state, LesionState::accepted) << when;
    EXPECT_EQ(row->comment, "tight") << when;
    const auto stretches = evaluability.stretches(lad);
    ASSERT_EQ(stretches.size(), 2U) << when;
    EXPECT_TRUE(stretches[0].by_person) << when;
    EXPECT_EQ(stretches[1].grade, analysis::Evaluability::limited) << when;
  };
  stands("before");
  bench.edit(lumen::VesselRename{lcx, "OM1"});
  EXPECT_EQ(board.missing(), 0) << "another name is nothing to be looked at";
  bench.edit(lumen::BranchDelete{lcx});
  stands("deleted");
  EXPECT_EQ(board.missing(), 1) << "what lies beside it is other than it was";
  EXPECT_TRUE(evaluability.stretches(lcx).empty());
  ASSERT_TRUE(bench.undo());
  stands("undone");
  EXPECT_EQ(board.missing(), 2);
  ASSERT_TRUE(bench.redo());
  stands("done again");
  // At other abscissas nothing that was found can stand.
  bench.edit(lumen::AxisTrim{lad, 32.0});
  bench.profile(lad);
  ASSERT_TRUE(narrow());
  EXPECT_EQ(narrow()->state, LesionState::accepted);
  EXPECT_EQ(evaluability.stretches(lad).size(), 2U);
  EXPECT_EQ(evaluability.stretches(lad)[1].grade, analysis::Evaluability::not_evaluable) << "not known";
}

TEST_F(LesionTable, AVesselThatIsHardlyAnArteryHasNoGradeUntilItIsChecked) {
  CaseFile file =
      CaseFile::create(folder / "a.ostia", narrowed_tube("RCA", 40.0, 1.5, 20.0, 0.6), reference_);
  keep_certainty(file, hardly_an_artery(*file.model(), 0.01));
  bench.set_session(Session(std::move(file)));
  bench.set_image({std::make_shared<const imaging::ImageVolume>(image), reference_});
  bench.profile(vessel());
  ASSERT_EQ(board.rows().size(), 1U);
  EXPECT_EQ(board.rows()[0].bar(), GradeBar::unlikely);
  VesselMark mark;
  mark.vessel = vessel();
  mark.checked = true;
  bench.annotate(MarkVessel{mark});
  EXPECT_EQ(board.rows()[0].bar(), GradeBar::none);
}

TEST_F(LesionTable, AWorkCanBeCancelledAndAVesselWithoutAWallIsNotTriedAgain) {
  open();
  bench.profile(vessel());
  const auto work = board.work();
  ASSERT_TRUE(work);
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(work->found(cancelled), Cancelled);
  EXPECT_TRUE(board.take(*work, std::nullopt));
  EXPECT_FALSE(board.work());
  ASSERT_EQ(board.rows().size(), 1U);
  EXPECT_FALSE(board.rows()[0].lesion.plaque);
}

}  // namespace
}  // namespace ostia::session
