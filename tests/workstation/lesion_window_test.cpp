// The table of lesions in the window: filled without being asked for, walked through, judged and commented by
// keys, filtered, sorted, copied, kept in the case.

#include "measuring/lesion_list.h"
#include "measuring/lesion_texts.h"
#include "measuring/lesions.h"
#include "tube_case.h"
#include "vessels/evaluability.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>

#include <QAction>
#include <QApplication>
#include <QClipboard>
#include <QComboBox>
#include <QHeaderView>
#include <QLineEdit>
#include <QTest>
#include <QWindow>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ostia::workstation::testing::wait_until;
using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::StartsWith;

constexpr double made_percent = 50.0;

struct LesionWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;
  LesionList* list = nullptr;

  LesionWindow() {
    imaging::write_image(image, testing::tube_image(0.01 * made_percent));
    session::CaseFile::create(case_file, testing::tube_model(0.01 * made_percent),
                              session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    open();
  }
  void open() {
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
    list = test->window().findChild<LesionList*>("lesions");
  }
  /// All that is found by itself is there, and in the table.
  bool is_known() {
    const auto filled = [&] {
      return test->window().lesions().idle() && test->window().evaluability().idle() && narrow() &&
             narrow()->text(plaque_column) != "?" && narrow()->text(evaluable_column) != "?";
    };
    return wait_until(filled, 60000);
  }
  /// It is written anew a moment after the last change.
  void wait_for_table() {
    QApplication::processEvents();
    EXPECT_TRUE(wait_until([&] { return test->window().lesions().idle() && list->settled(); }));
  }
  void key(Qt::Key key, Qt::KeyboardModifiers modifiers = Qt::NoModifier) {
    QApplication::setActiveWindow(&test->window());  // keys reach commands of the active window alone
    test->picture("cpr1").setFocus();
    QTest::keyClick(test->window().windowHandle(), key, modifiers);
    wait_for_table();
  }
  QTreeWidgetItem* narrow() {
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      if (list->topLevelItem(i)->text(percent_column).toDouble() > 40.0) return list->topLevelItem(i);
    return nullptr;
  }
  QStringList shown() {
    QStringList out;
    for (int i = 0; i < list->topLevelItemCount(); ++i)
      if (!list->topLevelItem(i)->isHidden()) out << list->topLevelItem(i)->text(number_column);
    return out;
  }
};

TEST_F(LesionWindow, IsFilledWithoutBeingAskedFor) {
  ASSERT_TRUE(is_known());
  ASSERT_TRUE(narrow());
  EXPECT_NEAR(narrow()->text(percent_column).toDouble(), made_percent, 6.0);
  EXPECT_THAT(narrow()->text(segment_column).toStdString(), HasSubstr("LAD"));
  EXPECT_NE(narrow()->text(plaque_column), "?");
  EXPECT_EQ(narrow()->text(state_column), "open");
  EXPECT_FALSE(test->window().findChild<QWidget*>("lesions_missing")->isVisible());
}

TEST_F(LesionWindow, KeysWalkThroughAllViewsAndJudge) {
  ASSERT_TRUE(is_known());
  test->bench().cursor_mm.set(1.0);
  for (int i = 0; i < list->topLevelItemCount() && list->currentItem() != narrow(); ++i) key(Qt::Key_L);
  ASSERT_EQ(list->currentItem(), narrow());
  EXPECT_NEAR(test->bench().cursor_mm.get(), testing::throat_mm, 1.0);
  EXPECT_NEAR(test->bench().place.get().z(), testing::throat_mm, 1.0);
  key(Qt::Key_X);
  EXPECT_EQ(narrow()->text(state_column), "rejected");
  EXPECT_EQ(narrow()->text(grade_column), QStringLiteral("\u2013"));
  EXPECT_TRUE(narrow()->font(number_column).strikeOut());
  test->bench().undo();
  wait_for_table();
  EXPECT_EQ(narrow()->text(state_column), "open");
  key(Qt::Key_Y);
  EXPECT_EQ(narrow()->text(state_column), "accepted");
  key(Qt::Key_X, Qt::ShiftModifier);
  EXPECT_EQ(narrow()->text(state_column), "open");
  key(Qt::Key_Y);
  test->bench().cursor_mm.set(39.9);
  key(Qt::Key_X);
  EXPECT_EQ(narrow()->text(state_column), "accepted") << "the cursor was elsewhere";
  test->window().close();
  test.reset();
  const auto marks = session::CaseFile::open(case_file, session::OpenMode::read_only).annotations()->marks;
  ASSERT_EQ(marks.size(), 1U);
  ASSERT_EQ(marks[0].lesions.size(), 1U);
  EXPECT_EQ(marks[0].lesions[0].state, session::LesionState::accepted);
}

TEST_F(LesionWindow, OfALimitedStretchThereIsAPercentAndNoGrade) {
  ASSERT_TRUE(is_known());
  session::Workbench& bench = test->bench();
  const std::int32_t vessel = bench.vessel.get();
  const session::EvaluabilityWork work{
      bench.session().file().model(), {}, bench.image().volume, vessel, std::nullopt};
  session::EvaluabilityWork::Found found;
  found.vessel.vessel = vessel;
  found.vessel.stretches = {{0.0, 40.0, analysis::Evaluability::limited, {}, false}};
  ASSERT_TRUE(test->window().evaluability().board().take(work, found));
  wait_for_table();
  EXPECT_EQ(narrow()->text(evaluable_column), "limited");
  EXPECT_EQ(narrow()->text(grade_column), "not graded: limited");
  EXPECT_NEAR(narrow()->text(percent_column).toDouble(), made_percent, 6.0);
  EXPECT_TRUE(narrow()->toolTip(number_column).contains("vessel is Done"));
  bench.cursor_mm.set(testing::throat_mm);
  key(Qt::Key_Y);
  const QString grade = narrow()->text(grade_column);
  EXPECT_TRUE(grade == "2" || grade == "3") << grade.toStdString();
  key(Qt::Key_X, Qt::ShiftModifier);
  EXPECT_EQ(narrow()->text(grade_column), "not graded: limited");
  session::VesselMark mark = session::mark_or_new(*bench.session().file().annotations(), vessel);
  mark.checked = true;
  bench.annotate(session::MarkVessel{mark});
  wait_for_table();
  EXPECT_EQ(narrow()->text(grade_column), grade);
  EXPECT_FALSE(narrow()->toolTip(number_column).contains("vessel is Done"));
}

TEST_F(LesionWindow, ACommentIsTypedAndIsThereAgain) {
  ASSERT_TRUE(is_known());
  test->bench().cursor_mm.set(testing::throat_mm);
  QApplication::setActiveWindow(&test->window());
  ASSERT_TRUE(list->comment());
  auto* editor = list->findChild<QLineEdit*>();
  ASSERT_TRUE(editor);
  QTest::keyClicks(editor, "Yes, tight");
  QTest::keyClick(editor, Qt::Key_Return);
  ASSERT_TRUE(wait_until([&] { return narrow()->text(comment_column).startsWith("Yes, tight"); }));
  EXPECT_EQ(narrow()->text(state_column), "open") << "letters that are typed are no commands";
  test->window().close();
  test.reset();
  open();
  ASSERT_TRUE(is_known());
  EXPECT_THAT(narrow()->text(comment_column).toStdString(), StartsWith("Yes, tight"));
}

TEST_F(LesionWindow, FiltersSortsAndIsCopiedAsText) {
  ASSERT_TRUE(is_known());
  test->bench().cursor_mm.set(testing::throat_mm);
  key(Qt::Key_Y);
  auto* states = test->window().findChild<QComboBox*>("lesions_state");
  const int all = shown().size();
  states->setCurrentText("accepted");
  EXPECT_EQ(shown(), QStringList(narrow()->text(number_column)));
  const QStringList lines = list->as_text().split('\n');
  ASSERT_EQ(lines.size(), 3) << "a header, the lesion, and nothing";
  for (int i = 0; i < 2; ++i) EXPECT_EQ(lines[i].split('\t').size(), lesion_columns - 1);  // no pressures
  states->setCurrentIndex(0);
  EXPECT_EQ(shown().size(), all);
  auto* text = test->window().findChild<QLineEdit*>("lesions_filter");
  text->setText("no such thing");
  EXPECT_TRUE(shown().isEmpty());
  EXPECT_FALSE(list->walk(1));
  text->setText("ACCEPT");
  EXPECT_EQ(shown().size(), 1);
  text->clear();
  list->sortByColumn(percent_column, Qt::DescendingOrder);
  EXPECT_EQ(list->topLevelItem(0), narrow());
  list->setFocus();
  QTest::keyClick(list, Qt::Key_C, Qt::ControlModifier);
  EXPECT_EQ(QApplication::clipboard()->text().trimmed().split('\n').size(), 1 + all);
}

}  // namespace
}  // namespace ostia::workstation
