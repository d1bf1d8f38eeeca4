// Everything in the window can be seen and read: in each of its states, in every language, in a small and a
// large window. Run once more with QT_SCALE_FACTOR=2.
#include "language.h"
#include "layout_faults.h"
#include "tour.h"
#include "window_states.h"

#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QCheckBox>
#include <QHBoxLayout>
#include <QHeaderView>
#include <QLabel>
#include <QMenu>
#include <QMenuBar>
#include <QPushButton>
#include <QScreen>
#include <QStatusBar>
#include <QSurfaceFormat>
#include <QTest>
#include <QTranslator>
#include <QTreeWidget>
#include <clocale>

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
      for (const QString& fault : layout_faults(*window))
        ADD_FAILURE() << where.toStdString() << ": " << fault.toStdString();
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
    testing::let_work(250);
    expect_none(QString::fromStdString(state));
  }
}

TEST_P(Layout, ThePicturesKeepTheirRoomBesideTheQualityPanel) {
  Stage stage(size());
  stage.enter("truth");
  testing::let_work(250);
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
