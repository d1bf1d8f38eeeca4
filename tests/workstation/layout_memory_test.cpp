// The window is arranged as it was left: its size, its docks, tool bars and panels.

#include "shell/panel.h"
#include "window_hand.h"

#include "ostia/session/machine_state.h"

#include <gtest/gtest.h>

#include <QContextMenuEvent>
#include <QDockWidget>
#include <QMenu>
#include <QMenuBar>
#include <QSplitter>
#include <QTest>
#include <QToolBar>
#include <memory>

namespace ostia::workstation {
namespace {

using testing::TestWindow;

struct LayoutMemory : ::testing::Test {
  testing::Folder folder;
  std::filesystem::path state = folder / "state";
  std::unique_ptr<TestWindow> test = std::make_unique<TestWindow>(state);

  template <class Widget>
  Widget& child(const char* name) {
    auto* found = test->window().findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("the window has no ") + name);
    return *found;
  }
  void settle() { testing::let_work(100); }
  /// The program is left, and started again.
  void start_again() {
    test->window().close();
    test.reset();
    test = std::make_unique<TestWindow>(state);
    settle();
  }
  Qt::DockWidgetArea area_of(const char* dock) {
    return test->window().dockWidgetArea(&child<QDockWidget>(dock));
  }
  void put(const char* dock, Qt::DockWidgetArea area) {
    test->window().addDockWidget(area, &child<QDockWidget>(dock));
    child<QDockWidget>(dock).show();
    settle();
  }
};

TEST_F(LayoutMemory, NothingIsOpenAtFirst) {
  for (const char* dock : {"qa", "mesh", "phase_profile"})
    EXPECT_FALSE(child<QDockWidget>(dock).isVisible()) << dock;
  for (const char* bar : {"tools", "options"}) EXPECT_TRUE(child<QToolBar>(bar).isVisible()) << bar;
  EXPECT_FALSE(child<QToolBar>("phase_room").isVisible());
}

TEST_F(LayoutMemory, DocksComeBackWhereTheyStoodAndAsWideAsTheyWere) {
  put("qa", Qt::LeftDockWidgetArea);
  const int before = child<QDockWidget>("qa").width(), wanted = before + 60;
  test->window().resizeDocks({&child<QDockWidget>("qa")}, {wanted}, Qt::Horizontal);
  settle();
  ASSERT_EQ(child<QDockWidget>("qa").width(), wanted);
  start_again();
  EXPECT_TRUE(child<QDockWidget>("qa").isVisible());
  EXPECT_EQ(area_of("qa"), Qt::LeftDockWidgetArea);
  EXPECT_EQ(child<QDockWidget>("qa").width(), wanted);
  EXPECT_TRUE(child<QDockWidget>("qa").toggleViewAction()->isChecked());
  child<QDockWidget>("qa").close();
  start_again();
  EXPECT_FALSE(child<QDockWidget>("qa").isVisible());
  child<QDockWidget>("qa").toggleViewAction()->trigger();
  settle();
  EXPECT_EQ(child<QDockWidget>("qa").width(), wanted);
}

TEST_F(LayoutMemory, ADockThatWasNeverOpenHasItsOwnWidthAtFirst) {
  child<QDockWidget>("qa").toggleViewAction()->trigger();
  settle();
  const int own = child<QDockWidget>("qa").width();
  test.reset();  // as if the program had been ended: nothing is kept
  test = std::make_unique<TestWindow>(state);
  start_again();
  child<QDockWidget>("qa").toggleViewAction()->trigger();
  settle();
  EXPECT_EQ(child<QDockWidget>("qa").width(), own);
}

TEST_F(LayoutMemory, AToolBarThatWasPutAwayStaysAwayUntilARightClickOnTheMenuBar) {
  child<QToolBar>("options").toggleViewAction()->trigger();
  ASSERT_FALSE(child<QToolBar>("options").isVisible());
  start_again();
  EXPECT_FALSE(child<QToolBar>("options").isVisible());
  EXPECT_TRUE(child<QToolBar>("tools").isVisible());
  const QPoint at = test->window().menuBar()->geometry().center();
  QContextMenuEvent click(QContextMenuEvent::Mouse, at, test->window().mapToGlobal(at));
  QApplication::sendEvent(&test->window(), &click);
  auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
  ASSERT_TRUE(menu);
  ASSERT_TRUE(menu->actions().contains(child<QToolBar>("options").toggleViewAction()));
  child<QToolBar>("options").toggleViewAction()->trigger();
  menu->close();
  EXPECT_TRUE(child<QToolBar>("options").isVisible());
}

TEST_F(LayoutMemory, DocksOfAMeshOrAMotionKeepTheirPlaceAndWaitForOne) {
  put("mesh", Qt::LeftDockWidgetArea);
  put("phase_profile", Qt::TopDockWidgetArea);
  child<QToolBar>("phase_room").show();
  start_again();
  for (const char* dock : {"mesh", "phase_profile"})
    EXPECT_FALSE(child<QDockWidget>(dock).isVisible()) << dock;
  EXPECT_FALSE(child<QToolBar>("phase_room").isVisible());
  EXPECT_EQ(area_of("mesh"), Qt::LeftDockWidgetArea);
  EXPECT_EQ(area_of("phase_profile"), Qt::TopDockWidgetArea);
}

TEST_F(LayoutMemory, WhatAnotherVersionKeptIsLeftAlone) {
  put("qa", Qt::LeftDockWidgetArea);
  const std::string other = test->window().saveState(7).toBase64().toStdString();
  child<QDockWidget>("qa").close();
  test->window().addDockWidget(Qt::RightDockWidgetArea, &child<QDockWidget>("qa"));
  child<QDockWidget>("qa").hide();
  test->window().close();
  test.reset();
  for (const std::string& kept : {other, std::string("bm8gc3RhdGU="), std::string()}) {
    session::MachineState(state).set_setting("docks", kept);
    test = std::make_unique<TestWindow>(state);
    EXPECT_FALSE(child<QDockWidget>("qa").isVisible());
    EXPECT_EQ(area_of("qa"), Qt::RightDockWidgetArea);
    EXPECT_TRUE(child<QToolBar>("options").isVisible());
    test.reset();
  }
}

struct PanelMemory : LayoutMemory {
  QList<int> sizes(const char* splitter) { return child<QSplitter>(splitter).sizes(); }
  /// A little more for the first part; what it has then.
  QList<int> moved(const char* splitter) {
    QList<int> wanted = sizes(splitter);
    wanted.front() += 30;
    wanted.back() -= 30;
    child<QSplitter>(splitter).setSizes(wanted);
    settle();
    return sizes(splitter);
  }
};

TEST_F(PanelMemory, PanelsComeBackAsLargeAsTheyWere) {
  for (const char* splitter : {"rows", "columns", "side", "curved", "sections"}) {
    const QList<int> first = sizes(splitter), kept = moved(splitter);
    ASSERT_NE(first, kept) << splitter;
    start_again();
    for (int i = 0; i < kept.size(); ++i)
      EXPECT_NEAR(sizes(splitter)[i], kept[i], 2) << splitter << ", part " << i;
  }
}

TEST_F(PanelMemory, SizesOfOtherPanelsAreLeftAlone) {
  const QList<int> first = sizes("sections");
  ASSERT_NE(first, moved("sections"));
  const QList<int> curved = moved("curved");
  test->window().close();
  test.reset();
  {
    session::MachineState machine(state);
    ASSERT_EQ(machine.setting("panels.sections"), "section_panel neighbours_panel slice_panel");
    machine.set_setting("panels.sections", "section_panel slice_panel neighbours_panel");
  }
  test = std::make_unique<TestWindow>(state);
  settle();
  EXPECT_EQ(sizes("sections"), first);
  EXPECT_EQ(sizes("curved"), curved);
}

TEST_F(PanelMemory, EveryPanelHasANameOfItsOwn) {
  QStringList names;
  for (const Panel* panel : test->window().findChildren<Panel*>()) {
    EXPECT_FALSE(panel->objectName().isEmpty()) << panel->accessibleName().toStdString();
    EXPECT_FALSE(names.contains(panel->objectName())) << panel->objectName().toStdString();
    names << panel->objectName();
  }
  EXPECT_GE(names.size(), 8);
}

}  // namespace
}  // namespace ostia::workstation
