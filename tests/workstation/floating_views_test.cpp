// Views in windows of their own on a wide desk: they come and go, are kept in layouts, and never out of
// reach.

#include "shell/floating_views.h"

#include "shell/layouts.h"
#include "shell/panel.h"
#include "shell/screen_room.h"
#include "tube_window.h"
#include "views/planes_dock.h"

#include <gmock/gmock.h>

#include <QContextMenuEvent>
#include <QDockWidget>
#include <QMenu>
#include <QScreen>
#include <QSplitter>
#include <QTabWidget>
#include <set>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;
using testing::wait_until;

const QList<QRect> two_monitors{{0, 0, 1600, 1200}, {1600, 0, 1920, 1080}};
const QList<QRect> one_monitor{{0, 0, 1600, 1200}};

TEST(OnSomeScreen, WhatCanBeReachedStaysWhereItIs) {
  for (const QRect& place : {QRect(100, 100, 500, 400), QRect(2000, 50, 600, 500), QRect(1500, 200, 400, 300),
                             QRect(-300, 400, 500, 300), QRect(100, 1150, 500, 400), QRect(0, 0, 5000, 300)})
    EXPECT_EQ(on_some_screen(place, two_monitors), place);
}

TEST(OnSomeScreen, WhatCannotComesToTheNearestScreenWithItsSize) {
  EXPECT_EQ(on_some_screen({2000, 50, 600, 500}, one_monitor), QRect(1000, 50, 600, 500));
  EXPECT_EQ(on_some_screen({1580, 100, 400, 300}, one_monitor), QRect(1200, 100, 400, 300))
      << "twenty pixels are no grip";
  EXPECT_EQ(on_some_screen({100, -200, 400, 300}, one_monitor), QRect(100, 0, 400, 300))
      << "its upper edge is what a hand takes";
  EXPECT_EQ(on_some_screen({4000, 3000, 600, 500}, two_monitors), QRect(2920, 580, 600, 500));
  EXPECT_EQ(on_some_screen({2000, 1195, 400, 300}, two_monitors), QRect(2000, 780, 400, 300));
}

TEST(OnSomeScreen, WhatIsLargerThanTheScreenIsMadeToFit) {
  EXPECT_EQ(on_some_screen({3000, 50, 2500, 1800}, one_monitor), one_monitor[0]);
  EXPECT_EQ(on_some_screen({3000, 50, 2500, 700}, one_monitor), QRect(0, 50, 1600, 700));
}

TEST(OnSomeScreen, WithoutScreensNothingMoves) {
  EXPECT_EQ(on_some_screen({9000, 9000, 10, 10}, {}), QRect(9000, 9000, 10, 10));
}

/// The window on the left half of the screen, as on the left of two monitors.
struct Floating : testing::TubeWindow {
  Floating() {
    open_case();
    window().setGeometry(0, 0, 1600, 1150);
    settle();
  }
  void command(const char* id) {
    part<QAction>(id)->trigger();
    settle();
  }
  QWidget* own_window(const char* name) {
    QWidget* top = part<QWidget>(name)->window();
    return top == &window() ? nullptr : top;
  }
  std::map<std::string, QRect> places() {
    std::map<std::string, QRect> all;
    for (const char* name :
         {"vessels", "lists", "cpr1", "cpr2", "section", "slice", "tree", "profile", "lesions"}) {
      const auto* one = part<QWidget>(name);
      if (one->isVisible()) all[name] = QRect(one->mapTo(&window(), QPoint(0, 0)), one->size());
    }
    return all;
  }
  /// The tree draws: many colours are on the screen there.
  bool tree_is_drawn() {
    const QWidget& tree = window().scene();
    return wait_until(
        [&] {
          const QPoint at = tree.mapToGlobal(QPoint(0, 0));
          const QImage shown = QGuiApplication::primaryScreen()
                                   ->grabWindow(0, at.x(), at.y(), tree.width(), tree.height())
                                   .toImage();
          std::set<QRgb> colors;
          for (int y = 0; y < shown.height(); y += 2)
            for (int x = 0; x < shown.width(); x += 2) colors.insert(shown.pixel(x, y));
          return colors.size() > 50;
        },
        20000);
  }
  void start_again() {
    window().close();
    test.reset();
    test = std::make_unique<testing::TestWindow>(folder / "state");
    test->open(case_file);
    settle();
  }
};

TEST_F(Floating, EachViewLeavesTheWindowAndComesBackToItsPlace) {
  const auto before = places();
  for (const char* name :
       {"vessels", "lists", "cpr1", "cpr2", "section", "slice", "tree", "profile", "lesions"}) {
    const std::string id = std::string("view.float_") + name;
    command(id.c_str());
    QWidget* own = own_window(name);
    ASSERT_TRUE(own) << name;
    EXPECT_TRUE(own->isVisible() && part<QWidget>(name)->isVisible()) << name;
    EXPECT_TRUE(part<QAction>(id.c_str())->isChecked()) << name;
    if (std::string(name) == "tree") {
      EXPECT_TRUE(tree_is_drawn());
    }
    own->close();  // as its title's button does
    ASSERT_TRUE(wait_until([&] { return !own_window(name); }, 3000)) << name;
    settle();
    EXPECT_FALSE(part<QAction>(id.c_str())->isChecked()) << name;
    EXPECT_EQ(places(), before) << name;
  }
  EXPECT_TRUE(tree_is_drawn());
}

TEST_F(Floating, TheColumnOfWhatHasLeftClosesUp) {
  const int section = part<QWidget>("section")->width();
  command("view.float_cpr1");
  command("view.float_cpr2");
  EXPECT_FALSE(part<QSplitter>("curved")->isVisible());
  EXPECT_GT(part<QWidget>("section")->width(), section + 100) << "the others have its room";
  command("view.float_tree");
  EXPECT_TRUE(own_window("tree"));
  // One view alone, and all that are here again.
  emit qobject_cast<Panel*>(part<QWidget>("section_panel"))->maximise_wanted();
  settle();
  EXPECT_FALSE(part<QWidget>("profile")->isVisible());
  EXPECT_TRUE(part<QWidget>("cpr1")->isVisible()) << "it is in its own window";
  emit qobject_cast<Panel*>(part<QWidget>("section_panel"))->maximise_wanted();
  settle();
  EXPECT_TRUE(part<QWidget>("profile")->isVisible());
  EXPECT_FALSE(part<QSplitter>("curved")->isVisible());
  command("view.layout_reading");
  EXPECT_FALSE(own_window("cpr1") || own_window("cpr2") || own_window("tree"));
  EXPECT_TRUE(part<QSplitter>("curved")->isVisible());
}

TEST_F(Floating, ARightClickOnTheTitleTakesTheViewOut) {
  auto* panel = qobject_cast<Panel*>(part<QWidget>("slice_panel"));
  QWidget* title = panel->findChild<QLabel*>();
  const auto choose = [&] {
    const QPoint at = title->rect().center();
    QContextMenuEvent event(QContextMenuEvent::Mouse, at, title->mapToGlobal(at));
    QApplication::sendEvent(title, &event);
    ASSERT_TRUE(wait_until([&] { return panel->findChild<QMenu*>("panel_menu"); }, 3000));
    auto* menu = panel->findChild<QMenu*>("panel_menu");
    QTest::mouseClick(menu, Qt::LeftButton, {}, menu->actionGeometry(menu->actions().front()).center());
    settle();
  };
  choose();
  EXPECT_TRUE(own_window("slice"));
  choose();
  EXPECT_FALSE(own_window("slice"));
}

TEST_F(Floating, KeysOfTheWindowWorkInTheViewsOwn) {
  command("view.float_cpr1");
  QWidget* own = own_window("cpr1");
  own->activateWindow();
  part<QWidget>("cpr1")->setFocus();
  ASSERT_TRUE(wait_until([&] { return part<QWidget>("cpr1")->hasFocus(); }, 3000));
  const double cursor = test->bench().cursor_mm.get();
  QTest::keyClick(part<QWidget>("cpr1"), Qt::Key_Down);
  EXPECT_NE(test->bench().cursor_mm.get(), cursor);
  const bool shown = test->bench().contours_shown.get();
  QTest::keyClick(part<QWidget>("cpr1"), Qt::Key_Space);
  EXPECT_NE(test->bench().contours_shown.get(), shown) << "a shortcut of the main window";
}

TEST_F(Floating, ALayoutOverTwoMonitorsIsKeptAndRestored) {
  ASSERT_GE(QGuiApplication::primaryScreen()->geometry().width(), 3200) << "this test needs a wide screen";
  const std::map<std::string, QRect> wanted{{"cpr1", {1650, 40, 500, 900}},
                                            {"cpr2", {2200, 40, 500, 900}},
                                            {"tree", {2720, 60, 460, 420}},
                                            {"profile", {1700, 960, 900, 200}},
                                            {"lists", {2750, 520, 400, 300}}};
  for (const auto& [name, place] : wanted) {
    command(("view.float_" + name).c_str());
    own_window(name.c_str())->setGeometry(place);
  }
  settle();
  window().layouts().save("Two monitors");
  command("view.layout_reading");
  for (const auto& [name, place] : wanted) EXPECT_FALSE(own_window(name.c_str())) << name;
  start_again();
  for (const auto& [name, place] : wanted) EXPECT_FALSE(own_window(name.c_str())) << name;
  window().layouts().show_own("Two monitors");
  settle();
  for (const auto& [name, place] : wanted) {
    ASSERT_TRUE(own_window(name.c_str())) << name;
    EXPECT_TRUE(own_window(name.c_str())->isVisible()) << name;
    EXPECT_EQ(own_window(name.c_str())->geometry(), place) << name;
  }
  EXPECT_TRUE(tree_is_drawn());
  // As it was left, too.
  start_again();
  for (const auto& [name, place] : wanted) {
    ASSERT_TRUE(own_window(name.c_str())) << name;
    EXPECT_TRUE(own_window(name.c_str())->isVisible()) << name;
    EXPECT_EQ(own_window(name.c_str())->geometry(), place) << name;
  }
}

TEST_F(Floating, WhatStoodOnAMonitorThatIsGoneComesBackToThisOne) {
  const QRect screen = QGuiApplication::primaryScreen()->availableGeometry();
  command("view.float_cpr1");
  window().planes().show();
  window().planes().setFloating(true);
  window().planes().setGeometry(300, 200, 500, 420);
  settle();
  auto values = window().layouts().now();
  EXPECT_THAT(values["views.floating"], HasSubstr("cpr1_panel "));
  values["views.floating"] =
      "cpr1_panel 7000 300 600 500;tree_panel -4000 -900 9000 9000;none 1 2 3 4;cpr2_panel x";
  window().layouts().arrange(values);
  window().planes().setGeometry(9000, 200, 500, 420);
  window().layouts().arrange(window().layouts().now());
  settle();
  for (const char* name : {"cpr1", "tree"}) {
    ASSERT_TRUE(own_window(name)) << name;
    EXPECT_TRUE(screen.contains(own_window(name)->geometry())) << name;
  }
  EXPECT_EQ(own_window("cpr1")->size(), QSize(600, 500));
  EXPECT_FALSE(own_window("cpr2")) << "what cannot be read is left out";
  ASSERT_TRUE(window().planes().isFloating());
  EXPECT_TRUE(screen.intersects(window().planes().geometry()));
  // The screens are others while the window is open.
  own_window("cpr1")->setGeometry(8000, 300, 600, 500);
  settle();
  emit QGuiApplication::primaryScreen()->availableGeometryChanged(screen);
  EXPECT_TRUE(wait_until([&] { return screen.contains(own_window("cpr1")->geometry()); }, 3000));
}

}  // namespace
}  // namespace ostia::workstation
