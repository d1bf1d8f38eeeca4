// The window with its help, on a screen.
#include "help/help.h"

#include "commands/keyboard.h"
#include "commands/shortcuts_page.h"
#include "commands/table.h"
#include "help/manual_dialog.h"
#include "help/tour.h"
#include "shell/main_window.h"
#include "shell/preferences_dialog.h"

#include <QVTKOpenGLNativeWidget.h>
#include <gtest/gtest.h>

#include <QApplication>
#include <QDoubleSpinBox>
#include <QKeySequenceEdit>
#include <QLabel>
#include <QLineEdit>
#include <QListWidget>
#include <QPushButton>
#include <QTemporaryDir>
#include <QTest>
#include <QTextBrowser>
#include <QToolBar>
#include <QToolButton>
#include <QTreeWidget>
#include <QWindow>
#include <set>

namespace ostia::workstation {
namespace {

class HelpTest : public ::testing::Test {
 protected:
  void SetUp() override { start(); }
  void start() {
    window_ = std::make_unique<MainWindow>(folder_.path().toStdString());
    window_->resize(1500, 900);
    window_->show();
    window_->activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(window_.get()));
    help_ = window_->findChild<Help*>();
    ASSERT_NE(help_, nullptr);
  }
  session::Tool tool() { return window_->bench().tool.get(); }
  template <class Widget>
  Widget* child(const char* name) {
    return window_->findChild<Widget*>(name);
  }
  QTemporaryDir folder_;
  std::unique_ptr<MainWindow> window_;
  Help* help_ = nullptr;
};

TEST_F(HelpTest, WhatTakesTheKeyboardHasANameForScreenReaders) {
  for (const QWidget* widget : window_->findChildren<QWidget*>()) {
    if (widget->focusPolicy() == Qt::NoFocus || widget->objectName().startsWith("qt_")) continue;
    if (qobject_cast<const QLineEdit*>(widget) || qobject_cast<const QLabel*>(widget) ||
        widget->inherits("QTabBar") || widget->inherits("QWindowContainer") || widget->inherits("QTabWidget"))
      continue;
    EXPECT_FALSE(widget->accessibleName().isEmpty() && widget->toolTip().isEmpty() &&
                 widget->property("text").toString().isEmpty())
        << widget->metaObject()->className() << ' ' << widget->objectName().toStdString();
  }
}

TEST_F(HelpTest, AKeyChoosesATool) {
  child<QWidget>("cpr1")->setFocus();
  QTest::keyClick(window_->windowHandle(), Qt::Key_B);
  EXPECT_EQ(tool(), session::Tool::brush);
  QTest::keyClick(window_->windowHandle(), Qt::Key_Escape);
  EXPECT_EQ(tool(), session::Tool::browse);
}

TEST_F(HelpTest, LettersTypedIntoALineChooseNoTool) {
  auto* box = child<QDoubleSpinBox>("reach");
  box->setFocus();
  QTest::keyClick(window_->windowHandle(), Qt::Key_B);
  QTest::keyClick(window_->windowHandle(), Qt::Key_Period);
  EXPECT_EQ(tool(), session::Tool::browse);
  QLineEdit line(window_->centralWidget());
  line.show();
  line.setFocus();
  for (const int key : {Qt::Key_B, Qt::Key_D, Qt::Key_Comma, Qt::Key_1})
    QTest::keyClick(window_->windowHandle(), static_cast<Qt::Key>(key));
  EXPECT_EQ(line.text(), "bd,1");
  EXPECT_EQ(tool(), session::Tool::browse);
}

TEST_F(HelpTest, SpaceOnAButtonPressesIt) {
  auto* button = new QPushButton("x", window_->centralWidget());
  int pressed = 0;
  QObject::connect(button, &QPushButton::clicked, [&] { ++pressed; });
  button->show();
  button->setFocus();
  const bool contours = window_->bench().contours_shown.get();
  QTest::keyClick(window_->windowHandle(), Qt::Key_Space);
  EXPECT_EQ(pressed, 1);
  EXPECT_EQ(window_->bench().contours_shown.get(), contours);
  child<QWidget>("cpr1")->setFocus();
  QTest::keyClick(window_->windowHandle(), Qt::Key_Space);
  EXPECT_NE(window_->bench().contours_shown.get(), contours);
}

TEST_F(HelpTest, KeysOfTheOtherSchemeHoldAtOnceAndAreKept) {
  window_->commands().set_keys(window_->commands().keys().in_scheme(ShortcutScheme::research));
  child<QWidget>("cpr1")->setFocus();
  QTest::keyClick(window_->windowHandle(), Qt::Key_W);
  EXPECT_EQ(tool(), session::Tool::drag);
  EXPECT_TRUE(child<QAction>("tool.drag")->toolTip().contains("[W]"));
  start();
  EXPECT_EQ(window_->commands().keys().scheme(), ShortcutScheme::research);
  EXPECT_EQ(child<QAction>("tool.drag")->shortcut(), QKeySequence("W"));
}

TEST_F(HelpTest, TheDialogRefusesAKeyThatIsTaken) {
  child<QAction>("edit.preferences")->trigger();
  auto* dialog = window_->findChild<PreferencesDialog*>();
  auto* list = dialog->findChild<QTreeWidget*>("commands");
  const auto found = list->findItems("Draw", Qt::MatchExactly | Qt::MatchRecursive);
  ASSERT_EQ(found.size(), 1);
  list->setCurrentItem(found.front());
  auto* editor = dialog->findChild<QKeySequenceEdit*>("keys");
  const auto* trouble = dialog->findChild<QLabel*>("trouble");
  editor->setKeySequence(QKeySequence("B"));
  emit editor->editingFinished();
  EXPECT_TRUE(trouble->text().contains("Brush")) << trouble->text().toStdString();
  EXPECT_EQ(child<QAction>("tool.draw")->shortcut(), QKeySequence("W"));
  editor->setKeySequence(QKeySequence("J"));
  emit editor->editingFinished();
  EXPECT_EQ(trouble->text(), "");
  EXPECT_EQ(child<QAction>("tool.draw")->shortcut(), QKeySequence("J"));
}

TEST_F(HelpTest, FocusGoesRoundAllPanels) {
  const auto station = [] {
    if (QGuiApplication::focusWindow() && QGuiApplication::focusWindow()->inherits("QVTKOpenGLWindow"))
      return QString("tree");
    for (QWidget* at = QApplication::focusWidget(); at; at = at->parentWidget())
      if (Keyboard::stations().contains(at->objectName())) return at->objectName();
    return QString();
  };
  std::set<QString> seen;
  for (int i = 0; i < Keyboard::stations().size(); ++i) {
    const QString before = station();
    QTest::keyClick(window_->windowHandle(), Qt::Key_Tab, Qt::ControlModifier);
    // The tree's window gets the keyboard from the X server, a moment later.
    EXPECT_TRUE(QTest::qWaitFor([&] { return station() != before; })) << before.toStdString();
    seen.insert(station());
  }
  // Of the two lists behind one tab one is shown.
  EXPECT_EQ(seen.size(), static_cast<std::size_t>(Keyboard::stations().size() - 1));
}

TEST_F(HelpTest, AltAndANumberGoToAPanelBehindATabToo) {
  QTest::keyClick(window_->windowHandle(), Qt::Key_9, Qt::AltModifier);
  EXPECT_EQ(QApplication::focusWidget(), child<QWidget>("steps"));
  QTest::keyClick(window_->windowHandle(), Qt::Key_4, Qt::AltModifier);
  EXPECT_EQ(QApplication::focusWidget(), child<QWidget>("section"));
  QTest::keyClick(window_->windowHandle(), Qt::Key_F11);
  EXPECT_TRUE(child<QWidget>("section")->isVisible());
  EXPECT_FALSE(child<QWidget>("cpr1")->isVisible());
  QTest::keyClick(window_->windowHandle(), Qt::Key_F11);
  EXPECT_TRUE(child<QWidget>("cpr1")->isVisible());
}

TEST_F(HelpTest, ThePageOfKeysIsSearched) {
  help_->show_shortcuts();
  auto* page = window_->findChild<ShortcutsPage*>();
  auto* list = page->findChild<QTreeWidget*>();
  const auto shown = [&] {
    int count = 0;
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      for (int j = 0; j < list->topLevelItem(i)->childCount(); ++j)
        count += list->topLevelItem(i)->isHidden() || list->topLevelItem(i)->child(j)->isHidden() ? 0 : 1;
    return count;
  };
  const int all = shown();
  EXPECT_GT(all, static_cast<int>(window_->commands().all().size()));
  page->findChild<QLineEdit*>("search")->setText("ctrl wheel");
  EXPECT_EQ(shown(), 1);
  page->findChild<QLineEdit*>("search")->setText("no such thing");
  EXPECT_EQ(shown(), 0);
  page->findChild<QLineEdit*>("search")->clear();
  EXPECT_EQ(shown(), all);
}

TEST_F(HelpTest, TheTourGoesThroughByKeysAndIsNotShownAgain) {
  EXPECT_TRUE(Help::wants_tour(window_->machine()));
  qunsetenv("OSTIA_NO_TOUR");
  help_->greet();
  qputenv("OSTIA_NO_TOUR", "1");
  auto* tour = window_->findChild<Tour*>();
  ASSERT_NE(tour, nullptr);
  for (int i = 0; i < tour->count(); ++i) {
    EXPECT_EQ(tour->step(), i);
    EXPECT_TRUE(window_->rect().contains(tour->geometry())) << i;
    QTest::keyClick(QApplication::focusWidget(), Qt::Key_Right);
  }
  EXPECT_FALSE(tour->isVisible());
  EXPECT_FALSE(Help::wants_tour(session::MachineState(folder_.path().toStdString())));
}

TEST_F(HelpTest, TheTourStaysAwayWhereTheEnvironmentSaysSo) {
  ASSERT_FALSE(qEnvironmentVariableIsEmpty("OSTIA_NO_TOUR"));
  help_->greet();
  EXPECT_EQ(window_->findChild<Tour*>(), nullptr);
}

TEST_F(HelpTest, EveryPageOfTheManualOpensWithItsPictures) {
  ManualDialog dialog(window_.get());
  auto* contents = dialog.findChild<QListWidget*>("contents");
  auto* page = dialog.findChild<QTextBrowser*>("page");
  std::set<QString> texts;
  for (int i = 0; i < contents->count(); ++i) {
    contents->setCurrentRow(i);
    const QString text = page->toPlainText();
    EXPECT_GT(text.size(), 400) << contents->item(i)->text().toStdString();
    EXPECT_TRUE(texts.insert(text).second) << "a page stands there twice";
  }
}

TEST_F(HelpTest, AllToolsAreInTheBarOfANarrowWindow) {
  window_->resize(1280, 800);
  QTest::qWait(50);
  for (const QToolButton* button : child<QToolBar>("tools")->findChildren<QToolButton*>()) {
    if (button->objectName() == "qt_toolbar_ext_button") {
      EXPECT_FALSE(button->isVisible());
    } else if (button->defaultAction()) {
      EXPECT_TRUE(button->isVisible()) << button->text().toStdString();
      EXPECT_FALSE(button->icon().isNull()) << button->text().toStdString();
    }
  }
  auto* slab = child<QDoubleSpinBox>("slab");
  EXPECT_LE(slab->mapTo(window_.get(), QPoint(slab->width(), 0)).x(), window_->width());
}

}  // namespace
}  // namespace ostia::workstation
