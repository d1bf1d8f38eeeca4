// Vessels by hand in the window: the sample's right coronary deleted and put back by clicks, and a case's
// first vessel taken back and deleted.

#include "measuring/lesion_list.h"
#include "measuring/lesion_texts.h"
#include "measuring/lesions.h"
#include "sample_patient.h"
#include "tube_case.h"
#include "vessels/evaluability.h"
#include "vessels/list.h"
#include "views/scene_widget.h"
#include "window_hand.h"

#include "ostia/analysis/aha_segments.h"
#include "ostia/imaging/image_file.h"
#include "ostia/imaging/sampling.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QApplication>
#include <QLineEdit>
#include <QMessageBox>
#include <QTest>
#include <algorithm>
#include <cstdint>
#include <map>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::TestWindow;
using testing::wait_until;
using view::Vec3;

constexpr double compare_step_mm = 2.0, end_mm = 4.0, branch_mm = 5.0;

/// Clicks with the mouse at a place of the patient, on the axial slice through it.
int click_at(TestWindow& test, const Vec3& place) {
  test.bench().place.set(place);
  PictureWidget& slice = test.picture("slice");
  testing::let_rest();
  const auto at = slice.view().project(place);
  if (!at) return 0;
  const double ratio = slice.devicePixelRatioF();
  const QPoint where(static_cast<int>(std::lround(at->px.x() / ratio)),
                     static_cast<int>(std::lround(at->px.y() / ratio)));
  QTest::mouseClick(&slice, Qt::LeftButton, Qt::NoModifier, where);
  return 1;
}

std::int32_t named(const session::Workbench& bench, const std::string& name) {
  for (const geometry::Vessel& vessel : bench.model()->tree.vessels)
    if (vessel.name == name) return vessel.id;
  return session::Workbench::no_vessel;
}

/// The program's sample in its coarse form, made once for all tests of this process.
struct Sample {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", file = folder / "sample.ostia";
  session::ImageReference reference;

  Sample() { reference = testing::make_sample_patient(image, file); }
};

struct SampleWindow : ::testing::Test {
  testing::Folder folder;
  TestWindow test{folder / "state"};

  SampleWindow() {
    static const Sample sample;
    fs::copy_file(sample.file, folder / "sample.ostia");
    session::MachineState(folder / "state").remember_image(sample.reference.sha256, sample.image);
    test.open(folder / "sample.ostia");
  }
};

TEST_F(SampleWindow, TheRightCoronaryComesBackByThreeClicksAsItWas) {
  session::Workbench& bench = test.bench();
  const std::int32_t rca = named(bench, "RCA");
  ASSERT_NE(rca, session::Workbench::no_vessel);
  const auto axis = lumen::vessel(*bench.model(), rca).axis;
  const std::vector<double> branches = analysis::branch_abscissas(*bench.model(), rca);
  const QColor color = test.window().scene().color_of(rca);
  auto* list = test.window().findChild<VesselList*>("vessels");
  const auto row_of = [&](const char* name) {
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      if (list->topLevelItem(i)->text(0) == name) return i;
    return -1;
  };
  const int row = row_of("RCA");
  std::map<double, double> before;
  for (double s = end_mm; s < axis->length() - end_mm; s += compare_step_mm) {
    const bool mouth =
        std::any_of(branches.begin(), branches.end(), [&](double b) { return std::abs(b - s) < branch_mm; });
    const auto section = bench.section(rca, s);
    if (!mouth && section && section->found) before[s] = section->diameter_mm;
  }
  ASSERT_GT(before.size(), 20U);
  const Vec3 ostium = axis->point(1.0), end = axis->point(axis->length() - 1.0);

  list->setCurrentItem(list->topLevelItem(row));
  QTest::keyClick(list, Qt::Key_Delete);
  ASSERT_EQ(named(bench, "RCA"), session::Workbench::no_vessel);
  int clicks = 0;
  test.window().findChild<QAction*>("tool.add_artery")->trigger();  // its button
  ++clicks;
  clicks += click_at(test, ostium);
  clicks += click_at(test, end);
  EXPECT_LE(clicks, 3);
  ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }, 120000));
  const std::int32_t again = named(bench, "RCA");
  ASSERT_NE(again, session::Workbench::no_vessel);
  EXPECT_EQ(bench.vessel.get(), again);
  testing::let_rest();
  EXPECT_EQ(row_of("RCA"), row);
  EXPECT_EQ(test.window().scene().color_of(again), color);

  const auto now = lumen::vessel(*bench.model(), again).axis;
  std::vector<double> off;
  for (const auto& [s, diameter] : before) {
    const geometry::AxisFoot foot = now->nearest_foot(axis->point(s));
    const auto section = bench.section(again, foot.s_mm);
    if (foot.past_end || !section || !section->found) continue;
    off.push_back(std::abs(section->diameter_mm - diameter));
  }
  ASSERT_GT(off.size(), before.size() * 9 / 10);
  std::sort(off.begin(), off.end());
  RecordProperty("median_um", static_cast<int>(1000.0 * off[off.size() / 2]));
  RecordProperty("p90_um", static_cast<int>(1000.0 * off[off.size() * 9 / 10]));
  EXPECT_LE(off[off.size() / 2], 0.05);
  EXPECT_LE(off[off.size() * 9 / 10], 0.05) << "largest " << off.back();
}

TEST_F(SampleWindow, AWayUpTheAortaIsRefusedWithTheReasonAndNothingIsAdded) {
  session::Workbench& bench = test.bench();
  const auto axis = lumen::vessel(*bench.model(), named(bench, "RCA")).axis;
  const imaging::ImageVolume& image = *bench.image().volume;
  // Back from the ostium into the aorta, and up as far as it is bright.
  constexpr double back_mm = 12.0, bright_hu = 250.0, least_up_mm = 15.0;
  const Vec3 inside = axis->point(0.0) - back_mm * axis->frame(0.0).tangent;
  Vec3 up = inside;
  while (up.z() - inside.z() < 40.0 && imaging::sample(image, up + Vec3(0.0, 0.0, 1.0)) > bright_hu)
    up.z() += 1.0;
  ASSERT_GT(up.z() - inside.z(), least_up_mm);
  const std::size_t vessels = bench.model()->tree.vessels.size();
  test.window().findChild<QAction*>("tool.add_artery")->trigger();
  ASSERT_EQ(click_at(test, axis->point(1.0)), 1);
  ASSERT_EQ(click_at(test, up), 1);
  QMessageBox* box = nullptr;
  ASSERT_TRUE(wait_until([&] {
    for (QWidget* widget : QApplication::topLevelWidgets())
      if (auto* one = qobject_cast<QMessageBox*>(widget); one && one->isVisible()) box = one;
    return box != nullptr;
  }));
  const QString said = box->text() + box->informativeText();
  EXPECT_TRUE(said.contains("wider than a coronary artery")) << said.toStdString();
  EXPECT_TRUE(said.contains("click a place in the vessel itself")) << said.toStdString();
  box->close();
  EXPECT_EQ(bench.model()->tree.vessels.size(), vessels);
  EXPECT_FALSE(bench.undo()) << "there is nothing to take back";
}

TEST_F(SampleWindow, TheReadersWordOnOneVesselStandsWhileAnotherGoesAndComesBack) {
  session::Workbench& bench = test.bench();
  auto* rows = test.window().findChild<LesionList*>("lesions");
  const auto key = [&](Qt::Key which, Qt::KeyboardModifiers with = Qt::NoModifier) {
    QApplication::setActiveWindow(&test.window());  // keys reach commands of the active window alone
    test.picture("cpr1").setFocus();
    QTest::keyClick(test.window().windowHandle(), which, with);
    QApplication::processEvents();
    EXPECT_TRUE(wait_until([&] { return rows->settled(); }));
  };
  const std::int32_t rca = named(bench, "RCA");
  const auto axis = lumen::vessel(*bench.model(), rca).axis;
  const Vec3 ostium = axis->point(1.0), end = axis->point(axis->length() - 1.0);
  // Some lesion of another vessel, of which all is known that the program finds by itself.
  const auto is_wanted = [&](const std::optional<session::LesionRow>& row) {
    return row && row->vessel != rca && row->lesion.plaque && row->evaluable;
  };
  const auto is_there = [&] {
    const auto& known = test.window().lesions().board().rows();
    return std::any_of(known.begin(), known.end(), is_wanted);
  };
  ASSERT_TRUE(wait_until(is_there, 120000));
  // What is found while a comment is being written waits until it is: the table would not rest before.
  const auto all_found = [&] {
    return test.window().lesions().idle() && test.window().evaluability().idle();
  };
  ASSERT_TRUE(wait_until(all_found, 120000));
  for (int i = 0; i <= rows->topLevelItemCount() && !is_wanted(rows->at_cursor()); ++i) key(Qt::Key_L);
  ASSERT_TRUE(is_wanted(rows->at_cursor()));
  key(Qt::Key_1, Qt::ControlModifier);  // evaluable, by the reader
  key(Qt::Key_Y);
  key(Qt::Key_K, Qt::ShiftModifier);
  auto* editor = rows->findChild<QLineEdit*>();
  ASSERT_TRUE(editor);
  QTest::keyClicks(editor, "tight");
  QTest::keyClick(editor, Qt::Key_Return);
  const auto stands = [&](const char* when) {
    for (int i = 0; i < rows->topLevelItemCount(); ++i) {
      const QTreeWidgetItem& row = *rows->topLevelItem(i);
      if (!row.text(comment_column).startsWith("tight")) continue;
      EXPECT_EQ(row.text(state_column), "accepted") << when;
      EXPECT_EQ(row.text(evaluable_column), "evaluable (reader)") << when;
      EXPECT_NE(row.text(plaque_column), "?") << when << ": what was found of it is gone";
      return;
    }
    ADD_FAILURE() << when << ": the lesion is not in the table";
  };
  ASSERT_TRUE(wait_until([&] {
    const auto row = rows->at_cursor();
    return row && row->comment == "tight" && rows->settled();
  }));
  stands("said");
  auto* list = test.window().findChild<VesselList*>("vessels");
  for (int i = 0; i < list->topLevelItemCount(); ++i)
    if (list->topLevelItem(i)->text(0) == "RCA") list->setCurrentItem(list->topLevelItem(i));
  QTest::keyClick(list, Qt::Key_Delete);
  ASSERT_EQ(named(bench, "RCA"), session::Workbench::no_vessel);
  ASSERT_TRUE(wait_until([&] { return rows->settled(); }));
  stands("the other deleted");
  test.window().findChild<QAction*>("tool.add_artery")->trigger();
  click_at(test, ostium);
  click_at(test, end);
  ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }, 120000));
  ASSERT_NE(named(bench, "RCA"), session::Workbench::no_vessel);
  ASSERT_TRUE(wait_until([&] { return rows->settled(); }));
  stands("put back");
  const auto steps = bench.session().file().edits().size();
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_EQ(named(bench, "RCA"), session::Workbench::no_vessel);
  stands("undone");
  key(Qt::Key_Z, Qt::ControlModifier);
  ASSERT_TRUE(wait_until([&] { return named(bench, "RCA") != session::Workbench::no_vessel; }))
      << steps << " steps were " << bench.session().file().edits().size();
  stands("undone twice");
}

TEST_F(SampleWindow, ThePlaneIn3DAndTheListFollowTheVesselChosenAtOnce) {
  session::Workbench& bench = test.bench();
  bench.cursor_mm.set(0.0);
  bench.vessel.set(named(bench, "RCA"));
  bench.cursor_mm.set(0.0);
  // Once nothing changes any more: on a busy machine a part may come later than the rest.
  const auto picture = [&] {
    std::vector<std::uint8_t> before;
    for (int i = 0; i < 20; ++i) {
      testing::let_rest();
      std::vector<std::uint8_t> now = test.window().scene().scene().snapshot(200, 200).rgba;
      if (now == before) break;
      before = std::move(now);
    }
    return before;
  };
  const auto of_rca = picture();
  bench.vessel.set(named(bench, "LAD"));  // the same abscissa
  const auto of_lad = picture();
  EXPECT_TRUE(of_rca != of_lad);
  // What is drawn is what a fresh cursor draws.
  bench.cursor_mm.set(1.0);
  bench.cursor_mm.set(0.0);
  EXPECT_TRUE(picture() == of_lad);
}

struct FirstVessel : ::testing::Test {
  testing::Folder folder;
  TestWindow test{folder / "state"};
  bool idle() {
    return wait_until([&] { return !test.window().jobs().any(); }, 60000);
  }
  QAction* action(const char* id) { return test.window().findChild<QAction*>(id); }
  void begin() {
    imaging::write_image(folder / "tube.nrrd", testing::tube_image());
    test.window().open(folder / "tube.nrrd");
    ASSERT_TRUE(idle());
    test.bench().tool.set(session::Tool::add_vessel);
    ASSERT_EQ(click_at(test, {0.0, 0.0, 2.0}), 1);
    ASSERT_EQ(click_at(test, {0.0, 0.0, 36.0}), 1);
    ASSERT_TRUE(idle());
    ASSERT_TRUE(test.bench().has_case());
  }
};

TEST_F(FirstVessel, IsTakenBackAndDoneAgain) {
  begin();
  const double length = test.bench().axis()->length();
  ASSERT_TRUE(action("edit.undo")->isEnabled());
  action("edit.undo")->trigger();
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_TRUE(test.bench().image().volume);
  EXPECT_FALSE(action("edit.undo")->isEnabled());
  ASSERT_TRUE(action("edit.redo")->isEnabled());
  action("edit.redo")->trigger();
  ASSERT_TRUE(wait_until([&] { return test.bench().has_case(); }));
  EXPECT_EQ(test.bench().axis()->length(), length);
  EXPECT_FALSE(action("edit.redo")->isEnabled());
  // A later step is taken back before it.
  test.bench().edit(lumen::VesselRename{test.bench().vessel.get(), "LAD"});
  action("edit.undo")->trigger();
  EXPECT_TRUE(test.bench().has_case());
}

TEST_F(FirstVessel, IsDeletedLikeAnyOtherAndComesBackByUndo) {
  begin();
  auto* list = test.window().findChild<VesselList*>("vessels");
  list->setCurrentItem(list->topLevelItem(0));
  QTest::keyClick(list, Qt::Key_Delete);
  EXPECT_FALSE(test.bench().has_case());
  EXPECT_EQ(list->topLevelItemCount(), 0);
  ASSERT_TRUE(action("edit.undo")->isEnabled());
  action("edit.undo")->trigger();
  EXPECT_TRUE(wait_until([&] { return test.bench().has_case(); }));
}

TEST_F(FirstVessel, AnotherImageEndsWhatCouldComeBack) {
  begin();
  action("edit.undo")->trigger();
  ASSERT_TRUE(action("edit.redo")->isEnabled());
  imaging::write_image(folder / "other.nrrd", testing::tube_image(0.3));
  test.window().open(folder / "other.nrrd");
  ASSERT_TRUE(idle());
  EXPECT_FALSE(action("edit.redo")->isEnabled());
}

}  // namespace
}  // namespace ostia::workstation
