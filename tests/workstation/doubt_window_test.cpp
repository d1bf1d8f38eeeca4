// The doubtful places in the window: a list in the order of doubt, a key that goes through it in all views,
// and what a person has checked is out of it.

#include "tube_case.h"
#include "vessels/doubts.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>

#include <QAction>
#include <QApplication>
#include <QTabWidget>
#include <QTest>
#include <QWindow>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ostia::workstation::testing::wait_until;

constexpr std::int32_t lad = 4, rca = 14;  // of two_tubes

coronary::VesselPiece piece(double x_mm, double middle_mm, double probability) {
  coronary::VesselPiece one;
  one.from_mm = middle_mm - 5.0, one.to_mm = middle_mm + 5.0;
  one.place = {x_mm, 0.0, middle_mm};
  one.probability = probability;
  return one;
}

struct DoubtWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tubes.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;
  DoubtList* list = nullptr;

  DoubtWindow() {
    imaging::write_image(image, testing::tube_image());
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
  void open(bool with_probabilities) {
    {
      session::CaseFile made =
          session::CaseFile::create(case_file, testing::two_tubes(), session::image_reference(image));
      coronary::VesselCertainty first, second;
      first.vessel = lad, first.probability = 0.97;
      first.pieces = {piece(0.0, 5.0, 0.99), piece(0.0, 15.0, 0.55), piece(0.0, 25.0, 0.98),
                      piece(0.0, 35.0, 0.85)};
      second.vessel = rca, second.probability = 0.95;
      second.pieces = {piece(testing::second_tube_x_mm, 5.0, 0.99),
                       piece(testing::second_tube_x_mm, 20.0, 0.2)};
      if (with_probabilities) session::keep_certainty(made, {first, second});
    }
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
    list = test->window().findChild<DoubtList*>("doubts");
  }
  session::Workbench& bench() { return test->bench(); }
  void key(Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QApplication::setActiveWindow(&test->window());  // keys reach commands of the active window alone
    test->picture("cpr1").setFocus();
    QTest::keyClick(test->window().windowHandle(), Qt::Key_O, modifiers);
    QApplication::processEvents();
  }
  bool at(std::int32_t vessel, double s_mm) {
    return bench().vessel.get() == vessel && std::abs(bench().cursor_mm.get() - s_mm) < 0.1 &&
           std::abs(bench().place.get().z() - s_mm) < 0.1;
  }
  bool tab_is_shown() {
    auto* tabs = test->window().findChild<QTabWidget*>("lists");
    return tabs->isTabVisible(tabs->indexOf(list));
  }
  QStringList rows() {
    QStringList out;
    for (int i = 0; i < list->topLevelItemCount(); ++i) {
      const QTreeWidgetItem& item = *list->topLevelItem(i);
      out << item.text(0) + " | " + item.text(1) + " | " + item.text(2);
    }
    return out;
  }
  QTreeWidgetItem* in_vessels(std::int32_t vessel) {
    auto* vessels = test->window().findChild<VesselList*>("vessels");
    for (int i = 0; i < vessels->topLevelItemCount(); ++i)
      if (vessels->topLevelItem(i)->data(0, Qt::UserRole).toInt() == vessel) return vessels->topLevelItem(i);
    return nullptr;
  }
};

TEST_F(DoubtWindow, TheKeyGoesThroughThemInTheOrderOfDoubtInAllViews) {
  open(true);
  ASSERT_TRUE(tab_is_shown());
  EXPECT_EQ(rows(), QStringList({"RCA | 15.0 to 25.0 mm | 0.20", "LAD | 10.0 to 20.0 mm | 0.55",
                                 "LAD | 30.0 to 40.0 mm | 0.85"}));
  key();
  EXPECT_TRUE(at(rca, 20.0));
  EXPECT_EQ(list->currentItem(), list->topLevelItem(0));
  bench().cursor_mm.set(3.0);  // the reader looks about
  key();
  EXPECT_TRUE(at(lad, 15.0));
  key();
  EXPECT_TRUE(at(lad, 35.0));
  key();
  EXPECT_TRUE(at(lad, 35.0)) << "there is no other";
  key(Qt::ShiftModifier);
  EXPECT_TRUE(at(lad, 15.0));
  key(Qt::ShiftModifier);
  EXPECT_TRUE(at(rca, 20.0));
  key(Qt::ShiftModifier);
  EXPECT_TRUE(at(rca, 20.0));
}

TEST_F(DoubtWindow, ARowThatIsClickedBringsTheViewsThere) {
  open(true);
  auto* tabs = test->window().findChild<QTabWidget*>("lists");
  tabs->setCurrentWidget(list);
  QApplication::processEvents();
  QTest::mouseClick(list->viewport(), Qt::LeftButton, Qt::NoModifier,
                    list->visualItemRect(list->topLevelItem(1)).center());
  EXPECT_TRUE(at(lad, 15.0));
  key();
  EXPECT_TRUE(at(lad, 35.0)) << "the walk goes on from there";
}

TEST_F(DoubtWindow, AVesselThatIsDoneIsNotDoubtfulAndTheWalkGoesOnBehindIt) {
  open(true);
  key();
  ASSERT_TRUE(at(rca, 20.0));
  in_vessels(rca)->setCheckState(5, Qt::Checked);
  ASSERT_TRUE(wait_until([&] { return list->topLevelItemCount() == 2; }));
  key();
  EXPECT_TRUE(at(lad, 15.0));
  bench().undo();
  EXPECT_TRUE(wait_until([&] { return list->topLevelItemCount() == 3; }));
  key(Qt::ShiftModifier);
  EXPECT_TRUE(at(rca, 20.0));
  bench().edit(lumen::AxisTrim{lad, 25.0});
  EXPECT_TRUE(wait_until([&] { return list->topLevelItemCount() == 2; })) << "its end was cut off";
}

TEST_F(DoubtWindow, ACaseWithoutProbabilitiesShowsNoList) {
  open(false);
  EXPECT_FALSE(tab_is_shown());
  bench().cursor_mm.set(3.0);
  key();
  EXPECT_NEAR(bench().cursor_mm.get(), 3.0, 1e-9);
}

}  // namespace
}  // namespace ostia::workstation
