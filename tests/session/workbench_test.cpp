#include "ostia/session/workbench.h"

#include "report_cases.h"

#include "ostia/core/error.h"

#include <gtest/gtest.h>

#include <cmath>
#include <future>

namespace ostia::session {
namespace {

using namespace testing;

struct Table : ::testing::Test {
  TempFolder folder;
  Workbench bench;
  void open_tube() { bench.set_session(Session(CaseFile::create(folder / "a.ostia", tube_model()))); }
};

OpenImage small_image(char digit) {
  auto volume = std::make_shared<imaging::ImageVolume>();
  volume->geometry.size = {4, 4, 4};
  volume->voxels.assign(64, 100);
  return {volume, {std::string(64, digit), "image-small"}};
}

TEST_F(Table, ACaseSelectsItsFirstVesselAndPutsTheCursorOnIt) {
  int told = 0;
  const auto kept = bench.case_changed.observe([&] { ++told; });
  open_tube();
  EXPECT_EQ(told, 1);
  EXPECT_EQ(bench.vessel.get(), tube_vessel);
  ASSERT_TRUE(bench.axis());
  bench.cursor_mm.set(12.0);
  EXPECT_NEAR((bench.place.get() - bench.axis()->point(12.0)).norm(), 0.0, 1e-12);
  bench.cursor_mm.set(1e9);
  EXPECT_DOUBLE_EQ(bench.cursor_mm.get(), bench.axis()->length());
  bench.close_case();
  EXPECT_EQ(bench.vessel.get(), Workbench::no_vessel);
  EXPECT_FALSE(bench.axis());
  EXPECT_THROW(bench.session(), InvalidInput);
  EXPECT_THROW(bench.undo(), InvalidInput);
}

TEST_F(Table, AnImageOfAnotherPatientIsRefusedOnEitherSide) {
  bench.set_session(Session(
      CaseFile::create(folder / "a.ostia", tube_model(), ImageReference{std::string(64, 'a'), "one"})));
  EXPECT_THROW(bench.set_image(small_image('b')), InvalidInput);
  EXPECT_FALSE(bench.image().volume);
  bench.set_image(small_image('a'));
  EXPECT_TRUE(bench.image().volume);
  Session other(
      CaseFile::create(folder / "b.ostia", tube_model(), ImageReference{std::string(64, 'c'), "two"}));
  EXPECT_THROW(bench.set_session(std::move(other)), InvalidInput);
  EXPECT_EQ(bench.session().file().image()->pseudonym, "one");
}

TEST_F(Table, AnImageAloneMovesThePlaceIntoIt) {
  bench.place.set({1000.0, 0.0, 0.0});
  bench.set_image(small_image('a'));
  EXPECT_TRUE(bench.image().volume->geometry.contains(bench.place.get()));
}

TEST_F(Table, TheProfileIsMeasuredAgainWhereTheWallMoved) {
  open_tube();
  const auto at = [&](double s) { return analysis::at(*bench.profile(tube_vessel), s).diameter_mm; };
  EXPECT_NEAR(at(15.0), 3.0, 0.02);
  bench.edit(ring(15.0, 1.0));
  EXPECT_NEAR(at(15.0), 2.0, 0.05);
  EXPECT_NEAR(at(15.0), bench.section(tube_vessel, 15.0)->diameter_mm, 0.03);
  EXPECT_NEAR(at(25.0), 3.0, 0.02);
  ASSERT_TRUE(bench.undo());
  EXPECT_NEAR(at(15.0), 3.0, 0.02);
  ASSERT_TRUE(bench.redo());
  EXPECT_NEAR(at(15.0), 2.0, 0.05);
  // The same as measured from nothing.
  Workbench fresh;
  const lumen::LumenModel now = *bench.model();
  fresh.set_session(Session(CaseFile::create(folder / "b.ostia", now)));
  for (double s = 1.0; s < 29.0; s += 1.0)
    EXPECT_NEAR(at(s), analysis::at(*fresh.profile(tube_vessel), s).diameter_mm, 1e-3) << s;
}

TEST_F(Table, AVesselIsMeasuredBesideTheTableWhileTheModelIsTheSame) {
  open_tube();
  const std::optional<ProfileWork> work = bench.profile_work(tube_vessel);
  ASSERT_TRUE(work);
  const analysis::LumenProfile measured =
      std::async(std::launch::async, [&] { return work->measured(); }).get();
  EXPECT_TRUE(bench.take_profile(*work, measured));
  EXPECT_FALSE(bench.profile_work(tube_vessel)) << "it is measured";
  const analysis::LumenProfile again = analysis::lumen_profile(
      *bench.model(), [&](std::int32_t one) { return bench.session().live().surface(one); }, tube_vessel);
  ASSERT_EQ(bench.profile(tube_vessel)->sections.size(), again.sections.size());
  for (std::size_t i = 0; i < again.sections.size(); ++i)
    EXPECT_DOUBLE_EQ(bench.profile(tube_vessel)->sections[i].area_mm2, again.sections[i].area_mm2);
  core::TaskContext cancelled;
  cancelled.cancel();
  EXPECT_THROW(work->measured(cancelled), Cancelled);
  EXPECT_FALSE(bench.profile_work(tube_vessel + 77));
  bench.close_case();
  EXPECT_FALSE(bench.take_profile(*work, measured)) << "the case is no longer there";
  bench.set_session(Session(CaseFile::create(folder / "b.ostia", tube_model())));
  EXPECT_FALSE(bench.take_profile(*work, measured)) << "another model";
}

TEST_F(Table, AStenosisIsToldOnceItIsMeasured) {
  open_tube();
  EXPECT_TRUE(bench.stenoses(tube_vessel).empty());
  int told = 0;
  const auto kept = bench.stenoses_changed.observe([&] { ++told; });
  for (const double s : {13.0, 14.0, 15.0, 16.0, 17.0}) bench.edit(ring(s, 0.7));
  EXPECT_EQ(told, 0);
  EXPECT_TRUE(bench.known_stenoses(tube_vessel).empty());  // what must not wait sees the last known
  ASSERT_EQ(bench.stenoses(tube_vessel).size(), 1U);
  EXPECT_EQ(told, 1);
  EXPECT_EQ(bench.known_stenoses(tube_vessel).size(), 1U);
  EXPECT_NEAR(bench.stenoses(tube_vessel).front().diameter_percent, 100.0 * (1.0 - 0.7 / 1.5), 7.0);
}

TEST_F(Table, AnEventTellsWhatWasDismissedAndWhetherTheTreeChanged) {
  open_tube();
  std::vector<Vec3> dismissed;
  bool tree = false;
  const auto kept = bench.model_changed.observe([&](const ModelEvent& event) {
    dismissed = event.dismissed;
    tree = event.tree_changed;
  });
  bench.edit(ring(15.0, 1.9));
  EXPECT_FALSE(tree);
  ASSERT_FALSE(dismissed.empty());
  for (const Vec3& place : dismissed) EXPECT_NEAR(std::hypot(place.x(), place.y()), 1.5, 1e-6);
  bench.edit(renamed("RCA"));
  EXPECT_TRUE(tree);
  EXPECT_EQ(bench.vessel_name(tube_vessel), "RCA");
  bench.cursor_mm.set(29.0);
  bench.edit(lumen::AxisTrim{tube_vessel, 20.0});
  EXPECT_TRUE(tree);
  EXPECT_NEAR(bench.axis()->length(), 20.0, 0.5);
  EXPECT_LE(bench.cursor_mm.get(), bench.axis()->length());
}

TEST_F(Table, ADeletedVesselIsNoLongerSelected) {
  bench.set_session(Session(CaseFile::create(folder / "a.ostia", y_model())));
  const std::int32_t last = bench.model()->tree.vessels.back().id;
  bench.vessel.set(last);
  bench.edit(lumen::BranchDelete{last});
  EXPECT_NE(bench.vessel.get(), last);
  EXPECT_TRUE(bench.axis());
  ASSERT_TRUE(bench.undo());
  EXPECT_TRUE(bench.axis(last));
}

TEST_F(Table, AfterVesselsCameOrWentAllIsAsMeasuredFromNothing) {
  bench.set_session(Session(CaseFile::create(folder / "a.ostia", narrowed_y(1, 12.0, 0.5))));
  const std::int32_t lad = bench.model()->tree.vessels.front().id,
                     lcx = bench.model()->tree.vessels.back().id;
  const auto is_as_from_nothing = [&](const std::string& after) {
    Workbench fresh;
    const std::filesystem::path file = folder / (after + ".ostia");
    const lumen::LumenModel now = *bench.model();
    fresh.set_session(Session(CaseFile::create(file, now)));
    for (const geometry::Vessel& one : now.tree.vessels) {
      const analysis::LumenProfile &kept = *bench.profile(one.id), &anew = *fresh.profile(one.id);
      ASSERT_EQ(kept.sections.size(), anew.sections.size()) << after;
      for (std::size_t i = 0; i < anew.sections.size(); ++i)
        EXPECT_NEAR(kept.sections[i].diameter_mm, anew.sections[i].diameter_mm, 1e-3)
            << after << ", " << one.name << " at " << anew.sections[i].s_mm;
      const auto& line = bench.reference(one.id)->diameter_mm;
      const auto& line_anew = fresh.reference(one.id)->diameter_mm;
      ASSERT_EQ(line.size(), line_anew.size()) << after;
      for (std::size_t i = 0; i < line.size(); ++i)
        EXPECT_NEAR(line[i], line_anew[i], 1e-3) << after << ", " << one.name;
      EXPECT_EQ(bench.stenoses(one.id).size(), fresh.stenoses(one.id).size()) << after << ", " << one.name;
    }
  };
  for (const std::int32_t one : {lad, lcx}) bench.profile(one);
  bench.edit(lumen::VesselRename{lcx, "OM1"});
  EXPECT_FALSE(bench.profile_work(lad)) << "another name is nothing to be measured";
  is_as_from_nothing("renamed");
  bench.edit(lumen::BranchDelete{lcx});
  EXPECT_FALSE(bench.profile_work(lad)) << "it runs as before";
  is_as_from_nothing("deleted");
  ASSERT_TRUE(bench.undo());
  EXPECT_FALSE(bench.profile_work(lad));
  EXPECT_TRUE(bench.profile_work(lcx)) << "it was not there";
  is_as_from_nothing("undone");
  bench.edit(lumen::BranchSplit{lad, 22.0, "D1"});
  is_as_from_nothing("split");
  ASSERT_TRUE(bench.undo());
  is_as_from_nothing("joined again");
}

TEST_F(Table, WhatIsRefusedChangesNothing) {
  open_tube();
  int told = 0;
  const auto kept = bench.model_changed.observe([&](const ModelEvent&) { ++told; });
  EXPECT_THROW(bench.edit(ring(15.0, 20.0)), InvalidInput);
  EXPECT_EQ(told, 0);
  EXPECT_EQ(lumen::digest(*bench.model()), lumen::digest(tube_model()));
}

TEST_F(Table, MeasurementsAreStepsAmongEdits) {
  open_tube();
  int told = 0;
  const auto kept = bench.annotations_changed.observe([&] { ++told; });
  bench.annotate(added(analysis::MeasureKind::distance));
  bench.edit(ring(15.0, 1.9));
  EXPECT_EQ(told, 1);
  const auto found = bench.session().file().annotations();
  EXPECT_NEAR(bench.measured(found->measurements.front()).front().value,
              (found->measurements.front().points[0] - found->measurements.front().points[1]).norm(), 1e-9);
  EXPECT_TRUE(bench.undo());
  EXPECT_EQ(told, 1);
  EXPECT_TRUE(bench.undo());
  EXPECT_EQ(told, 2);
  EXPECT_FALSE(bench.undo());
  bench.go_to_step(3);
  EXPECT_EQ(bench.session().file().edits().size(), 1U);
}

TEST(WindowPresets, AreTheUsualOnes) {
  ASSERT_EQ(window_presets().size(), 4U);
  for (const WindowPreset& preset : window_presets()) EXPECT_GT(preset.window.width_hu, 0.0);
  EXPECT_EQ(window_presets().front().name, "CTA");
}

}  // namespace
}  // namespace ostia::session
