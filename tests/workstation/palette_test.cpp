// The command palette, driven by keys and mouse: over a few commands on a desk without the window, and over
// the program's own.

#include "commands/palette.h"

#include "commands/palette_rows.h"
#include "commands/table.h"
#include "layout_faults.h"
#include "measuring/reporting.h"
#include "test_desk.h"
#include "tube_window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QLabel>
#include <QLineEdit>
#include <QListView>
#include <QMenu>
#include <QMenuBar>
#include <QScreen>
#include <QTest>

namespace ostia::workstation {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using testing::wait_until;

/// A hand in the palette of a window.
struct PaletteHand {
  QWidget& window;
  Palette* palette() const { return window.findChild<Palette*>(); }
  bool open() const { return palette() && palette()->isVisible(); }
  QLineEdit* line() const { return palette()->findChild<QLineEdit*>("palette_line"); }
  QListView* list() const { return palette()->findChild<QListView*>("palette_list"); }
  void type(const QString& text) const { QTest::keyClicks(line(), text); }
  void press(Qt::Key key) const { QTest::keyClick(line(), key); }
  QString shown(int row, int role = palette_text) const {
    return list()->model()->index(row, 0).data(role).toString();
  }
  int count() const { return list()->model()->rowCount(); }
  int current() const { return list()->currentIndex().row(); }
  bool gone() const {
    return QTest::qWaitFor([this] { return !palette(); }, 3000);
  }
};

struct PaletteTest : ::testing::Test {
  testing::Folder folder;
  testing::TestDesk test{folder / "state"};
  CommandTable* table = new CommandTable(test.desk());
  PaletteHand hand{test.window()};
  QLineEdit* field = new QLineEdit;
  QStringList ran;
  bool allowed = false;
  PaletteTest() {
    const auto add = [this](const QString& id, const QString& text, const QString& keys = {}) {
      table->add({.id = id, .text = text, .keys = {keys}, .run = [this, id] { ran << id; }});
    };
    add("file.open", "&Open a case\u2026", "Ctrl+O");
    add("view.next", "Next vessel");
    add("view.lesion", "Next stenosis", "L");
    add("file.mesh", "A &mesh\u2026", "Ctrl+M");
    table->add({.id = "view.plaque",
                .text = "Plaque",
                .run = [this] { ran << "view.plaque"; },
                .enabled = [this] { return allowed; },
                .why_not = [] { return QString("No outer wall is known."); }});
    QMenu* file = test.window().menuBar()->addMenu("&File");
    file->addAction(&table->action("file.open"));
    file->addMenu("&Export")->addAction(&table->action("file.mesh"));
    QMenu* view = test.window().menuBar()->addMenu("&View");
    for (const char* id : {"view.next", "view.lesion", "view.plaque"}) view->addAction(&table->action(id));
    table->dress();
    test.window().setCentralWidget(field);
    test.show();
    field->setFocus();
  }
  void begin() {
    (new Palette(*table, test.window()))->begin();
    ASSERT_TRUE(wait_until([this] { return hand.open(); }, 3000));
  }
};

TEST_F(PaletteTest, ShowsAllCommandsWithTheirKeysAndMenus) {
  begin();
  ASSERT_EQ(hand.count(), 5);
  EXPECT_EQ(hand.shown(0), "Open a case");
  EXPECT_EQ(hand.list()->model()->index(0, 0).data(palette_keys).toStringList(), QStringList("Ctrl+O"));
  EXPECT_EQ(hand.shown(3), "A mesh");
  EXPECT_EQ(hand.shown(3, palette_below), "File \u203a Export");
}

TEST_F(PaletteTest, EnterRunsWhatWasTypedAndTheKeyboardIsWhereItWas) {
  begin();
  EXPECT_TRUE(hand.line()->hasFocus());
  hand.type("sten next");
  ASSERT_EQ(hand.count(), 1);
  hand.press(Qt::Key_Return);
  ASSERT_TRUE(hand.gone());
  EXPECT_THAT(ran, ElementsAre("view.lesion"));
  EXPECT_TRUE(wait_until([this] { return field->hasFocus(); }, 3000))
      << "the display gives it back in its own time";
  EXPECT_EQ(field->text(), "") << "nothing of what was typed came here";
}

TEST_F(PaletteTest, ArrowsMoveRoundAndPagesStopAtTheEnds) {
  begin();
  EXPECT_EQ(hand.current(), 0);
  hand.press(Qt::Key_Down);
  EXPECT_EQ(hand.current(), 1);
  hand.press(Qt::Key_Up);
  hand.press(Qt::Key_Up);
  EXPECT_EQ(hand.current(), 4);
  hand.press(Qt::Key_PageUp);
  EXPECT_EQ(hand.current(), 0);
  hand.press(Qt::Key_PageDown);
  EXPECT_EQ(hand.current(), 4);
  hand.press(Qt::Key_Down);
  hand.press(Qt::Key_Down);
  hand.press(Qt::Key_Enter);
  ASSERT_TRUE(hand.gone());
  EXPECT_THAT(ran, ElementsAre("view.next"));
}

TEST_F(PaletteTest, EscapeClosesAndRunsNothing) {
  begin();
  hand.type("mesh");
  hand.press(Qt::Key_Escape);
  ASSERT_TRUE(hand.gone());
  EXPECT_TRUE(ran.isEmpty());
  EXPECT_TRUE(wait_until([this] { return field->hasFocus(); }, 3000));
}

TEST_F(PaletteTest, AClickRunsWhatIsUnderTheMouse) {
  begin();
  const QRect row = hand.list()->visualRect(hand.list()->model()->index(2, 0));
  QTest::mouseMove(hand.list()->viewport(), row.center());
  EXPECT_TRUE(wait_until([&] { return hand.current() == 2; }, 2000))
      << "the row under the mouse is the chosen one";
  QTest::mouseClick(hand.list()->viewport(), Qt::LeftButton, {}, row.center());
  ASSERT_TRUE(hand.gone());
  EXPECT_THAT(ran, ElementsAre("view.lesion"));
}

TEST_F(PaletteTest, AClickBesideItCloses) {
  begin();
  QTest::mouseClick(hand.palette(), Qt::LeftButton, {}, QPoint(-20, 300));
  ASSERT_TRUE(hand.gone());
  EXPECT_TRUE(ran.isEmpty());
}

TEST_F(PaletteTest, WhatCannotBeUsedSaysWhyAndIsNotRun) {
  begin();
  hand.type("plaq");
  ASSERT_EQ(hand.count(), 1);
  EXPECT_FALSE(hand.list()->model()->index(0, 0).data(palette_usable).toBool());
  EXPECT_THAT(hand.shown(0, palette_below).toStdString(), HasSubstr("No outer wall is known."));
  hand.press(Qt::Key_Return);
  QApplication::processEvents();
  EXPECT_TRUE(hand.open());
  EXPECT_TRUE(ran.isEmpty());
  hand.press(Qt::Key_Escape);
  ASSERT_TRUE(hand.gone());
  allowed = true;
  table->refresh();
  begin();
  hand.type("plaq");
  EXPECT_EQ(hand.shown(0, palette_below), "View");
  hand.press(Qt::Key_Return);
  ASSERT_TRUE(hand.gone());
  EXPECT_THAT(ran, ElementsAre("view.plaque"));
}

TEST_F(PaletteTest, WhatFitsNothingIsSaid) {
  begin();
  hand.type("xyzzy");
  EXPECT_EQ(hand.count(), 0);
  EXPECT_EQ(hand.palette()->findChild<QLabel*>("palette_hint")->text(), "No command fits.");
  hand.press(Qt::Key_Return);
  EXPECT_TRUE(hand.open());
  for (int i = 0; i < 5; ++i) hand.press(Qt::Key_Backspace);
  EXPECT_EQ(hand.count(), 5);
}

TEST_F(PaletteTest, ScatteredCharactersFitOnlyWhereNothingElseDoes) {
  begin();
  hand.type("nst");  // "Next stenosis"; "Next vessel" has them not
  ASSERT_EQ(hand.count(), 1);
  hand.press(Qt::Key_Escape);
  ASSERT_TRUE(hand.gone());
  begin();
  hand.type("ne");  // within "Next"; scattered in "Open a case"
  EXPECT_EQ(hand.count(), 2);
}

TEST_F(PaletteTest, IsAsHighAsItsLinesNeed) {
  begin();
  const int whole = hand.palette()->height();
  hand.type("next");
  EXPECT_LT(hand.palette()->height(), whole);
  EXPECT_EQ(hand.list()->height(), 2 * hand.list()->sizeHintForRow(0));
}

TEST_F(PaletteTest, StaysInANarrowWindow) {
  test.window().resize(420, 360);
  QApplication::processEvents();
  begin();
  const QRect window(test.window().mapToGlobal(QPoint(0, 0)), test.window().size());
  EXPECT_TRUE(window.contains(hand.palette()->geometry()));
}

// Over the program's own window -----------------------------------------------------------------------------

struct PaletteWindow : testing::TubeWindow {
  std::unique_ptr<PaletteHand> hand;
  void open_window() {
    open_case();
    hand = std::make_unique<PaletteHand>(PaletteHand{window()});
    window().activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&window()));
  }
  /// By its key, from wherever the keyboard is.
  void begin() {
    QTest::keyClick(window().windowHandle(), Qt::Key_K, Qt::ControlModifier);
    ASSERT_TRUE(wait_until([this] { return hand->open(); }, 3000));
  }
  void run(const QString& typed) {
    begin();
    hand->type(typed);
    hand->press(Qt::Key_Return);
    ASSERT_TRUE(hand->gone());
    testing::let_work(50);
  }
};

TEST_F(PaletteWindow, CtrlKOpensItAndACommandIsRun) {
  open_window();
  test->picture("cpr1").setFocus();
  run("brush");
  EXPECT_EQ(test->bench().tool.get(), session::Tool::brush);
  EXPECT_TRUE(wait_until([&] { return QApplication::focusWidget() == &test->picture("cpr1"); }, 3000));
  run("panel slice");
  EXPECT_TRUE(wait_until([&] { return QApplication::focusWidget() == &test->picture("slice"); }, 3000));
  run("file pin");
  EXPECT_EQ(window().reporting().pinned(), 1u) << "the view with the keyboard is pinned";
}

TEST_F(PaletteWindow, LettersTypedIntoItChooseNoTool) {
  open_window();
  test->picture("cpr1").setFocus();
  begin();
  for (const int key : {Qt::Key_B, Qt::Key_W, Qt::Key_Comma, Qt::Key_Space, Qt::Key_Escape})
    QTest::keyClick(hand->line(), static_cast<Qt::Key>(key));
  ASSERT_TRUE(hand->gone());
  EXPECT_EQ(test->bench().tool.get(), session::Tool::browse);
  EXPECT_TRUE(test->bench().contours_shown.get());
}

TEST_F(PaletteWindow, FindsACameraByItsMenuAndMovesIt) {
  open_window();
  const auto before = window().scene().scene().pose().towards;
  run("look rao caudal");
  EXPECT_TRUE(
      wait_until([&] { return (window().scene().scene().pose().towards - before).norm() > 0.1; }, 5000));
}

TEST_F(PaletteWindow, ItsTextsAreWholeAndReadable) {
  open_window();
  begin();
  const QStringList faults = testing::layout_faults(*hand->palette());
  EXPECT_TRUE(faults.isEmpty()) << faults.join('\n').toStdString();
}

}  // namespace
}  // namespace ostia::workstation
