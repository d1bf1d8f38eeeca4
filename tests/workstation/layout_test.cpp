// Everything in the window can be seen and read: in each of its states, in every language, in a small and a
// large window. Run once more with QT_SCALE_FACTOR=2.
#include "help/tour.h"
#include "layout_faults.h"
#include "painted_faults.h"
#include "shell/language.h"
#include "window_states.h"

#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QCheckBox>
#include <QDoubleSpinBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QTabWidget>
#include <QTest>
#include <QToolBar>
#include <QTranslator>
#include <QTreeWidget>
#include <array>
#include <clocale>
#include <set>

namespace ostia::workstation {
namespace {

using testing::layout_faults;
using testing::Stage;

// What a fault is, on windows made for it.
class Fault : public ::testing::Test {
 protected:
  QStringList of(QWidget& window) {
    window.show();
    QApplication::processEvents();
    return layout_faults(window);
  }
};

TEST_F(Fault, NoneWhereAllIsInItsPlace) {
  QWidget window;
  auto* row = new QHBoxLayout(&window);
  row->addWidget(new QLabel("Cross-section"));
  row->addWidget(new QPushButton("Open truth"));
  row->addWidget(new QCheckBox("Truth over the pictures"));
  EXPECT_TRUE(of(window).isEmpty()) << of(window).join('\n').toStdString();
}

TEST_F(Fault, ATextThatIsCutOff) {
  for (QWidget* widget : std::initializer_list<QWidget*>{
           new QLabel("Cross-section"), new QPushButton("Cross-section"), new QCheckBox("Cross-section")}) {
    QWidget window;
    window.resize(300, 100);
    widget->setParent(&window);
    widget->setGeometry(10, 10, 50, 30);
    EXPECT_EQ(of(window).size(), 1) << widget->metaObject()->className()
                                    << of(window).join('\n').toStdString();
  }
}

TEST_F(Fault, ALabelWithoutRoomForItsLines) {
  QWidget window;
  window.resize(300, 200);
  auto* label = new QLabel("Slices are missing or unevenly spaced in this series.", &window);
  label->setWordWrap(true);
  label->setGeometry(10, 10, 120, 20);
  EXPECT_EQ(of(window).size(), 1);
}

TEST_F(Fault, AnEntryOrATitleThatIsCutOffWithoutAToolTip) {
  QTreeWidget list;
  list.resize(300, 200);
  list.setColumnCount(2);
  list.setHeaderLabels({"Vessel", "Largest narrowing"});
  auto* item = new QTreeWidgetItem(&list, {"Left anterior descending artery", "57 %"});
  list.setColumnWidth(0, 90);
  list.header()->setStretchLastSection(false);
  list.setColumnWidth(1, 40);
  EXPECT_EQ(of(list).size(), 2) << of(list).join('\n').toStdString();
  item->setToolTip(0, "Left anterior descending artery");
  list.headerItem()->setToolTip(1, "Largest narrowing, percent of diameter");
  EXPECT_TRUE(of(list).isEmpty()) << of(list).join('\n').toStdString();
}

TEST_F(Fault, WhatLiesOverAnotherOrOutside) {
  QWidget window;
  window.resize(300, 100);
  auto* one = new QLabel("one", &window);
  auto* two = new QLabel("two", &window);
  one->setGeometry(10, 10, 60, 30);
  two->setGeometry(60, 20, 60, 30);
  EXPECT_EQ(of(window).size(), 1);
  two->setGeometry(270, 20, 60, 30);
  EXPECT_EQ(of(window).size(), 1);
  two->setGeometry(100, 20, 60, 30);
  EXPECT_TRUE(of(window).isEmpty());
}

constexpr int least_painted = 1280;  // narrower, views leave out texts that find no room

struct Setting {
  const char* language;
  int width, height;
};
void PrintTo(const Setting& setting, std::ostream* out) {
  *out << setting.language << ", " << setting.width << " x " << setting.height;
}

class Layout : public ::testing::TestWithParam<Setting> {
 protected:
  Layout() { use_language(std::string(GetParam().language)); }
  ~Layout() override {
    for (QTranslator* one : qApp->findChildren<QTranslator*>()) delete one;
    use_language(std::string("en"));
  }
  static void expect_none(const QString& where) {
    for (const QWidget* window : QApplication::topLevelWidgets()) {
      if (!window->isVisible() || window->windowType() == Qt::ToolTip || window->windowType() == Qt::Popup)
        continue;
      QStringList faults = layout_faults(*window);
      if (window->width() >= least_painted) faults += testing::painted_faults(*window);
      for (const QString& fault : faults) ADD_FAILURE() << where.toStdString() << ": " << fault.toStdString();
      if (!QGuiApplication::primaryScreen()->geometry().contains(window->geometry()))
        ADD_FAILURE() << where.toStdString() << ": " << window->objectName().toStdString()
                      << " is larger than the screen";
    }
  }
  static QSize size() { return {GetParam().width, GetParam().height}; }
};

TEST_P(Layout, EveryStateIsWholeAndReadable) {
  for (const std::string& state : testing::window_states()) {
    Stage stage(size());
    stage.enter(state);
    testing::let_rest();
    expect_none(QString::fromStdString(state));
  }
}

TEST_P(Layout, WhatIsPaintedOverPicturesIsWholeAndApart) {
  Stage stage(size());
  stage.enter("case");
  stage.crowd();
  expect_none("all that can be written");
  EXPECT_GT(testing::painted_count(stage.window()), 60);
  for (const char* command : {"view.stretched", "view.identity", "view.plaque", "view.float_cpr1",
                              "view.theme", "view.planes", "view.layout_planes", "view.layout_flat"}) {
    stage.window().findChild<QAction*>(command)->trigger();
    testing::let_rest();
    expect_none(command);
  }
  stage.window().findChild<QAction*>("view.layout_reading")->trigger();
  for (const char* view : {"cpr1", "section", "slice", "tree", "profile"}) {
    stage.show_alone(view);
    testing::let_rest();
    expect_none(view);
    stage.show_alone(view);
  }
}

TEST_P(Layout, ThePicturesKeepTheirRoomBesideTheQualityPanel) {
  Stage stage(size());
  stage.enter("truth");
  testing::let_rest();
  for (const char* view : {"cpr1", "cpr2", "section", "slice", "tree"})
    EXPECT_GE(stage.window().findChild<QWidget*>(view)->width(), 100) << view;
}

TEST_P(Layout, EveryPageOfTheTourIsWholeAndReadable) {
  Stage stage(size());
  stage.enter("tour");
  auto* tour = stage.window().findChild<Tour*>();
  for (int page = 0; page < tour->count(); ++page) {
    tour->go(page);
    testing::let_work(30);
    expect_none(QStringLiteral("tour, page %1").arg(page));
  }
}

TEST_P(Layout, WhatAToolSaysFitsIntoTheStatusBar) {
  Stage stage(size());
  stage.enter("case");
  const QStatusBar* bar = stage.window().statusBar();
  for (QAction* action : stage.window().findChildren<QAction*>()) {
    if (!action->objectName().startsWith("tool.") || !action->isCheckable()) continue;
    action->trigger();
    QApplication::processEvents();
    int room = bar->width();
    for (const QObject* one : bar->children())
      if (const auto* part = qobject_cast<const QWidget*>(one); part && part->isVisible())
        room = std::min(room, part->x());
    const QString text = bar->currentMessage();
    EXPECT_FALSE(text.isEmpty()) << action->objectName().toStdString();
    EXPECT_LE(bar->fontMetrics().horizontalAdvance(text) + 12, room) << text.toStdString();
  }
}

TEST_P(Layout, EveryMenuFitsOnTheScreen) {
  Stage stage(size());
  stage.enter("case");
  for (const QMenu* menu : stage.window().findChildren<QMenu*>())
    if (menu->parentWidget() == stage.window().menuBar()) {
      EXPECT_LT(menu->sizeHint().height(), size().height()) << menu->title().toStdString();
      EXPECT_LT(menu->sizeHint().width(), size().width()) << menu->title().toStdString();
    }
}

/// A window that fills a small screen, or a larger one at 200 %.
class SmallScreen : public Layout {
 protected:
  const QRect room_{QPoint(0, 0), size()};
  static constexpr std::array panes{"vessels", "lists", "cpr1", "cpr2",
                                    "section", "slice", "tree", "profile"};
  /// Of what can be seen of the window nothing lies outside of it.
  void expect_within(MainWindow& window, const std::string& where) {
    EXPECT_EQ(window.size(), room_.size()) << where;
    EXPECT_LE(window.minimumSizeHint().width(), room_.width()) << where;
    EXPECT_LE(window.minimumSizeHint().height(), room_.height()) << where;
    for (const char* name : panes) {
      const auto* pane = window.findChild<QWidget*>(name);
      ASSERT_TRUE(pane) << name;
      if (!pane->isVisible()) continue;
      const QRect shown(pane->mapTo(&window, QPoint(0, 0)), pane->size());
      EXPECT_TRUE(room_.contains(shown))
          << where << ": " << name << " reaches to " << shown.right() << ", " << shown.bottom();
    }
    expect_none(QString::fromStdString(where));
  }
};

TEST_P(SmallScreen, EveryStateOfTheWindowFits) {
  for (const std::string state : {"empty", "case", "editing", "section_alone", "profile_alone", "measuring",
                                  "steps", "truth", "heart"}) {
    Stage stage(size());
    stage.enter(state);
    testing::let_rest();
    expect_within(stage.window(), state);
  }
}

TEST_P(SmallScreen, EveryDialogAndMenuFits) {
  for (const std::string state : {"series", "preferences", "preferences_keys", "about", "manual", "keys",
                                  "report", "tour", "complaint", "orientation"}) {
    Stage stage(size());
    stage.enter(state);
    testing::let_rest();
    for (const QWidget* window : QApplication::topLevelWidgets())
      if (window->isVisible() && window->windowType() != Qt::ToolTip) {
        EXPECT_LE(window->width(), room_.width()) << state << ": " << window->objectName().toStdString();
        EXPECT_LE(window->height(), room_.height()) << state << ": " << window->objectName().toStdString();
      }
    expect_none(QString::fromStdString(state));
  }
  Stage stage(size());
  for (const QMenu* menu : stage.window().findChildren<QMenu*>())
    EXPECT_LT(menu->sizeHint().height(), room_.height()) << menu->title().toStdString();
}

TEST_P(SmallScreen, TheTreeIsATabBesideTheListsAndComesBackWithTheRoom) {
  Stage stage(size());
  stage.enter("case");
  auto& tree = stage.window().scene();
  const auto* tabs = stage.window().findChild<QTabWidget*>("lists");
  const auto shown_tabs = [&] {
    int shown = 0;
    for (int i = 0; i < tabs->count(); ++i) shown += tabs->isTabVisible(i) ? 1 : 0;
    return shown;
  };
  ASSERT_EQ(shown_tabs(), 3);
  EXPECT_FALSE(tree.isVisible());
  for (const char* name : {"cpr1", "cpr2", "section", "slice"})
    EXPECT_GE(stage.window().findChild<QWidget*>(name)->width(), 100) << name;
  auto* list = stage.window().findChild<QTreeWidget*>("vessels");
  const auto color = [&] { return list->topLevelItem(0)->icon(0).pixmap(12, 12).toImage().pixelColor(6, 6); };
  const QColor unseen = color();  // of a vessel that the tree has not drawn yet
  stage.window().findChild<QAction*>("panel.tree")->trigger();
  // The tree is drawn, and has the colours that the list shows.
  const auto colors = [&] {
    const QImage shown = QGuiApplication::primaryScreen()
                             ->grabWindow(0, tree.mapToGlobal(QPoint(0, 0)).x(),
                                          tree.mapToGlobal(QPoint(0, 0)).y(), tree.width(), tree.height())
                             .toImage();
    std::set<QRgb> found;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) found.insert(shown.pixel(x, y));
    return found.size();
  };
  EXPECT_TRUE(testing::wait_until([&] { return colors() > 50; }, 20000)) << colors();
  EXPECT_EQ(color(), unseen);
  EXPECT_TRUE(tree.isVisible());
  EXPECT_EQ(tabs->currentIndex(), tabs->count() - 1);
  expect_within(stage.window(), "the tree's tab");

  stage.window().resize(1600, 1000);
  QApplication::processEvents();
  EXPECT_EQ(shown_tabs(), 2);
  EXPECT_TRUE(tree.isVisible());
  EXPECT_GT(tree.mapTo(&stage.window(), QPoint(0, 0)).x(),
            stage.window().findChild<QWidget*>("section")->mapTo(&stage.window(), QPoint(0, 0)).x());
  stage.window().resize(size());
  QApplication::processEvents();
  EXPECT_EQ(shown_tabs(), 3);
  expect_within(stage.window(), "narrow again");
}

TEST_P(SmallScreen, ToolsThatFindNoPlaceAreBehindTheArrow) {
  Stage stage(size());
  stage.enter("case");
  auto* tools = stage.window().findChild<QToolBar*>("tools");
  for (const QAction* action : tools->actions()) {
    const QWidget* button = tools->widgetForAction(const_cast<QAction*>(action));
    EXPECT_TRUE(button->isVisible()) << action->objectName().toStdString();
    EXPECT_TRUE(action->isSeparator() || !action->toolTip().isEmpty());
  }
  // A box is never seen without its name, nor the name alone.
  for (const char* name : {"reach", "ball", "slab"}) {
    auto* box = stage.window().findChild<QDoubleSpinBox*>(name);
    const QLabel* label = nullptr;
    for (const auto* one : stage.window().findChildren<QLabel*>())
      if (one->buddy() == box) label = one;
    ASSERT_TRUE(label) << name;
    EXPECT_EQ(label->isVisible(), box->isVisible()) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Settings, SmallScreen,
                         ::testing::Values(Setting{"en", 800, 600}, Setting{"de", 800, 600}),
                         [](const auto& test) { return std::string(test.param.language); });

INSTANTIATE_TEST_SUITE_P(Settings, Layout,
                         ::testing::Values(Setting{"en", 1280, 800}, Setting{"en", 1600, 1200},
                                           Setting{"de", 1280, 800}, Setting{"de", 1600, 1200}),
                         [](const auto& test) {
                           return std::string(test.param.language) + '_' + std::to_string(test.param.width);
                         });

}  // namespace
}  // namespace ostia::workstation

int main(int argc, char** argv) {
  ::testing::InitGoogleTest(&argc, argv);
  const ostia::workstation::testing::Folder folder;
  ostia::workstation::testing::pin_fonts(folder);
  QSurfaceFormat::setDefaultFormat(QVTKOpenGLNativeWidget::defaultFormat());
  QApplication::setAttribute(Qt::AA_EnableHighDpiScaling);
  QApplication::setAttribute(Qt::AA_UseHighDpiPixmaps);
  QApplication::setAttribute(Qt::AA_DontCreateNativeWidgetSiblings);
  QApplication application(argc, argv);
  std::setlocale(LC_NUMERIC, "C");
  ostia::workstation::testing::pin_look();
  return RUN_ALL_TESTS();
}
