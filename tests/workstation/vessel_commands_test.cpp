// Vessels split and joined from the window's menu and list.

#include "shell/step_list.h"
#include "tube_case.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QContextMenuEvent>
#include <QMenu>
#include <QStatusBar>
#include <QTimer>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::TestWindow;
using testing::wait_until;

struct VesselCommands : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  VesselCommands() {
    imaging::write_image(image, testing::tube_image());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
};

TEST_F(VesselCommands, SplitAtTheCursorAndJoinAgain) {
  TestWindow test(state);
  QAction* split = test.window().findChild<QAction*>("vessel.split");
  QAction* merge = test.window().findChild<QAction*>("vessel.merge");
  EXPECT_FALSE(split->isEnabled());
  EXPECT_FALSE(merge->isEnabled());
  test.open(case_file);
  EXPECT_TRUE(split->isEnabled());
  EXPECT_FALSE(merge->isEnabled());
  EXPECT_FALSE(split->toolTip().isEmpty());
  test.bench().cursor_mm.set(18.0);
  split->trigger();
  auto* list = test.window().findChild<VesselList*>("vessels");
  ASSERT_EQ(test.bench().model()->vessels.size(), 2U);
  EXPECT_EQ(list->topLevelItemCount(), 2);
  EXPECT_EQ(list->topLevelItem(1)->text(0), "LAD distal");
  EXPECT_NEAR(test.bench().axis(4)->length(), 18.0, 0.3);
  auto* steps = test.window().findChild<StepList*>("steps");
  EXPECT_TRUE(
      wait_until([&] { return steps->count() == 2 && steps->item(1)->text() == "Split a vessel"; }, 2000));
  EXPECT_FALSE(merge->isEnabled());

  const std::int32_t distal = test.bench().model()->tree.vessels[1].id;
  test.bench().vessel.set(distal);
  test.bench().cursor_mm.set(30.0);
  EXPECT_TRUE(merge->isEnabled());
  const auto place = test.bench().place.get();
  merge->trigger();
  ASSERT_EQ(test.bench().model()->vessels.size(), 1U);
  EXPECT_EQ(test.bench().vessel.get(), 4);
  EXPECT_LT((test.bench().place.get() - place).norm(), 1e-6);
  EXPECT_EQ(list->topLevelItemCount(), 1);
  test.window().findChild<QAction*>("edit.undo")->trigger();
  EXPECT_EQ(test.bench().model()->vessels.size(), 2U);
}

/// Chooses an entry of the menu that is open.
void choose_entry(const QString& wanted) {
  QTimer::singleShot(100, [wanted] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    if (!menu) return;
    for (QAction* one : menu->actions())
      if (one->text() == wanted) one->trigger();
    menu->close();
  });
}

TEST_F(VesselCommands, CutInTwoAtTheCursorAndConnectAgainElsewhere) {
  TestWindow test(state);
  QAction* cut = test.window().findChild<QAction*>("vessel.cut");
  QAction* connect = test.window().findChild<QAction*>("vessel.connect");
  EXPECT_FALSE(cut->isEnabled());
  test.open(case_file);
  EXPECT_TRUE(cut->isEnabled());
  EXPECT_FALSE(connect->isEnabled());  // there is but one vessel
  EXPECT_FALSE(cut->toolTip().isEmpty());
  EXPECT_FALSE(connect->toolTip().isEmpty());
  const std::string whole = lumen::digest(*test.bench().model());
  test.bench().cursor_mm.set(18.0);
  cut->trigger();
  ASSERT_EQ(test.bench().model()->vessels.size(), 2U);
  EXPECT_EQ(geometry::roots(test.bench().model()->tree).size(), 2U);
  const std::int32_t distal = test.bench().model()->tree.vessels[1].id;
  EXPECT_NEAR(test.bench().axis(distal)->length(), 22.0, 0.3);
  EXPECT_TRUE(connect->isEnabled());

  test.bench().cursor_mm.set(10.0);
  choose_entry("LAD distal");
  connect->trigger();
  EXPECT_TRUE(wait_until([&] { return geometry::roots(test.bench().model()->tree).size() == 1; }, 3000));
  EXPECT_NEAR(test.bench().axis(distal)->length(), 40.0, 0.5);
  EXPECT_LT(lumen::own_from_mm(test.bench().model()->tree, distal), 10.5);
  auto* steps = test.window().findChild<StepList*>("steps");
  EXPECT_TRUE(wait_until(
      [&] {
        return steps->count() == 3 && steps->item(1)->text() == "Cut a vessel in two" &&
               steps->item(2)->text() == "Connect a vessel";
      },
      2000));
  // The shown vessel comes from the other one: there is nothing that it could be connected to.
  test.bench().vessel.set(distal);
  test.bench().cursor_mm.set(30.0);
  QTimer::singleShot(100, [] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_NE(menu, nullptr);
    EXPECT_FALSE(menu->isEnabled());
    menu->close();
  });
  connect->trigger();
  testing::let_rest();
  for (int i = 0; i < 2; ++i) test.window().findChild<QAction*>("edit.undo")->trigger();
  EXPECT_EQ(lumen::digest(*test.bench().model()), whole);
}

TEST_F(VesselCommands, ASplitWithoutRoomIsSaidAndChangesNothing) {
  TestWindow test(state);
  test.open(case_file);
  const std::string before = lumen::digest(*test.bench().model());
  test.bench().cursor_mm.set(0.5);
  test.window().findChild<QAction*>("vessel.split")->trigger();
  EXPECT_TRUE(test.window().statusBar()->currentMessage().contains("choose"));
  EXPECT_EQ(lumen::digest(*test.bench().model()), before);
}

TEST_F(VesselCommands, TheListsContextMenuHasThemToo) {
  TestWindow test(state);
  test.open(case_file);
  test.bench().cursor_mm.set(18.0);
  auto* list = test.window().findChild<VesselList*>("vessels");
  const auto choose = [&](const QString& wanted) {
    bool enabled = false;
    QTimer::singleShot(200, [&] {
      auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
      if (!menu) return;
      for (QAction* one : menu->actions())
        if (one->text() == wanted && one->isEnabled()) {
          enabled = true;
          one->trigger();
        }
      menu->close();
    });
    QContextMenuEvent event(QContextMenuEvent::Mouse, QPoint(20, 20), list->mapToGlobal(QPoint(20, 20)));
    QApplication::sendEvent(list->viewport(), &event);
    return enabled;
  };
  EXPECT_FALSE(choose("Join with parent vessel"));
  EXPECT_TRUE(choose("Split at the cursor"));
  ASSERT_EQ(test.bench().model()->vessels.size(), 2U);
  test.bench().vessel.set(test.bench().model()->tree.vessels[1].id);
  test.bench().cursor_mm.set(30.0);
  EXPECT_TRUE(choose("Join with parent vessel"));
  EXPECT_EQ(test.bench().model()->vessels.size(), 1U);
  EXPECT_NEAR(test.bench().place.get().z(), 30.0, 1e-6);
  EXPECT_EQ(list->topLevelItemCount(), 1);
}

TEST_F(VesselCommands, AShownVesselThatIsDeletedLeavesTheList) {
  TestWindow test(state);
  test.open(case_file);
  test.bench().cursor_mm.set(18.0);
  test.window().findChild<QAction*>("vessel.split")->trigger();
  test.bench().vessel.set(test.bench().model()->tree.vessels[1].id);
  auto* list = test.window().findChild<VesselList*>("vessels");
  QKeyEvent key(QEvent::KeyPress, Qt::Key_Delete, Qt::NoModifier);
  QApplication::sendEvent(list, &key);
  EXPECT_EQ(test.bench().model()->vessels.size(), 1U);
  EXPECT_EQ(list->topLevelItemCount(), 1);
  EXPECT_EQ(test.bench().vessel.get(), 4);
}

}  // namespace
}  // namespace ostia::workstation
