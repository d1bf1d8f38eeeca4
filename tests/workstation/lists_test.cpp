// The lists at the window's side: what they show when the case is another, and what an edit leaves as a
// person had it.

#include "qa/dock.h"
#include "shell/step_list.h"
#include "tube_case.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/io/contour_file.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QDockWidget>
#include <QHeaderView>
#include <QLineEdit>
#include <QMenu>
#include <QScreen>
#include <QTabWidget>
#include <QTest>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;

constexpr std::int32_t tube = 4;

struct Lists : ::testing::Test {
  testing::Folder folder;
  fs::path state = folder / "state";
  fs::path image = folder / "a.nrrd", case_file = folder / "a.ostia", twin = folder / "a2.ostia";
  fs::path other_image = folder / "b.nrrd", other_case = folder / "b.ostia";
  Lists() {
    imaging::ImageVolume voxels = tube_image();
    imaging::write_image(image, voxels);
    voxels.voxels[5] = 17;
    imaging::write_image(other_image, voxels);
    session::MachineState machine(state);
    for (const auto& [file, of] :
         {std::pair(case_file, image), std::pair(twin, image), std::pair(other_case, other_image)}) {
      const session::ImageReference reference = session::image_reference(of);
      session::CaseFile::create(file, tube_model(), reference);
      machine.remember_image(reference.sha256, of);
    }
  }
  template <class List>
  static List& list(TestWindow& test, const char* name) {
    auto* found = test.window().findChild<List*>(name);
    if (!found) throw std::runtime_error(std::string("the window has no list ") + name);
    return *found;
  }
  static void rest() { testing::let_rest(); }
  static void open(TestWindow& test, const fs::path& what) {
    test.window().open(what);
    ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }, 60000));
    rest();
  }
  static void to_front(QWidget& list) {
    for (QWidget* up = &list; up; up = up->parentWidget()) {
      if (auto* tabs = qobject_cast<QTabWidget*>(up))
        for (int i = 0; i < tabs->count(); ++i)
          if (tabs->widget(i) == &list || tabs->widget(i)->isAncestorOf(&list)) tabs->setCurrentIndex(i);
      if (auto* dock = qobject_cast<QDockWidget*>(up)) {
        dock->show();
        dock->raise();
      }
    }
    rest();
  }
  /// With the keyboard in it.
  static void focus(TestWindow& test, QWidget& list) {
    QApplication::setActiveWindow(&test.window());
    list.setFocus(Qt::OtherFocusReason);
    ASSERT_TRUE(wait_until([&] { return list.hasFocus(); }, 5000));
  }
  static int different_pixels(const QImage& a, const QImage& b) {
    if (a.size() != b.size()) return -1;
    int count = 0;
    for (int y = 0; y < a.height(); ++y)
      for (int x = 0; x < a.width(); ++x) count += a.pixelColor(x, y) != b.pixelColor(x, y) ? 1 : 0;
    return count;
  }
  /// Of the places of `part` on the screen, those that are not what `part` would paint now.
  static int stale_pixels(TestWindow& test, QWidget& part) {
    const QPoint at = part.mapTo(&test.window(), QPoint(0, 0));
    const QImage screen =
        test.window().screen()->grabWindow(test.window().winId()).toImage().copy(QRect(at, part.size()));
    return different_pixels(screen, part.grab().toImage());
  }
  static void measure(TestWindow& test) {
    analysis::Measurement one;
    one.kind = analysis::MeasureKind::distance;
    one.points = {{0.0, 0.0, 5.0}, {0.0, 3.0, 9.0}};
    test.bench().annotate(session::MeasureAdd{one});
  }
  static void pull(TestWindow& test) {
    test.bench().edit(lumen::WallDrag{tube, {1.5, 0.0, 12.0}, {1.8, 0.0, 12.0}});
  }
  static QLineEdit* editor_of(QAbstractItemView& list) {
    QLineEdit* found = nullptr;
    wait_until([&] { return (found = list.viewport()->findChild<QLineEdit*>()) != nullptr; }, 3000);
    return found;
  }
};

TEST_F(Lists, OfACaseThatIsClosedNothingStaysOnTheScreen) {
  TestWindow test(state);
  open(test, case_file);
  measure(test);
  pull(test);
  rest();
  for (const char* name : {"vessels", "measurements", "steps"}) {
    auto& shown = list<QAbstractItemView>(test, name);
    to_front(shown);
    ASSERT_GT(shown.model()->rowCount(), 0) << name;
    if (auto* tree = qobject_cast<QTreeView*>(&shown)) tree->expandAll();
    rest();
    EXPECT_EQ(stale_pixels(test, *shown.viewport()), 0) << name << " while the case is open";
    const QImage with_case = shown.viewport()->grab().toImage();
    test.window().findChild<QAction*>("file.close")->trigger();
    rest();
    EXPECT_EQ(shown.model()->rowCount(), 0) << name;
    EXPECT_EQ(stale_pixels(test, *shown.viewport()), 0) << name << " when the case is closed";
    EXPECT_NE(different_pixels(with_case, shown.viewport()->grab().toImage()), 0) << name;
    open(test, case_file);
  }
}

struct ListsTruth : Lists {
  fs::path truth = folder / "truth.json";
  ListsTruth() {
    geometry::ContourSection section;
    section.section = "s01";
    section.vessel = "LAD";
    section.observer = "truth";
    for (double s = 5.0; s <= 15.0; s += 1.0) {
      geometry::Contour contour{s, {}};
      for (int i = 0; i < 48; ++i)
        contour.points.push_back({1.7 * std::cos(2 * M_PI * i / 48), 1.7 * std::sin(2 * M_PI * i / 48), s});
      section.contours.push_back(contour);
    }
    io::write_contours(truth, {{section}});
  }
  static int rows(TestWindow& test) { return list<QTreeWidget>(test, "qa_sections").topLevelItemCount(); }
};

TEST_F(ListsTruth, IsThatOfOnePatient) {
  TestWindow test(state);
  open(test, case_file);
  QaDock& qa = test.window().qa();
  qa.show();
  qa.open_truth(truth);
  ASSERT_TRUE(wait_until([&] { return rows(test) == 1; }));
  open(test, twin);  // another case of the same image
  EXPECT_TRUE(qa.check().has_truth());
  EXPECT_EQ(rows(test), 1);
  test.bench().close_case();
  open(test, case_file);
  EXPECT_TRUE(qa.check().has_truth());
  open(test, other_case);
  EXPECT_FALSE(qa.check().has_truth());
  EXPECT_TRUE(wait_until([&] { return rows(test) == 0; }, 3000));
  EXPECT_EQ(qa.findChild<QComboBox*>("qa_observer")->count(), 0);
  open(test, case_file);
  EXPECT_FALSE(qa.check().has_truth());
}

TEST_F(ListsTruth, GoesWithItsImage) {
  TestWindow test(state);
  open(test, case_file);
  QaDock& qa = test.window().qa();
  qa.show();
  qa.open_truth(truth);
  open(test, other_image);
  ASSERT_FALSE(test.bench().has_case());
  EXPECT_FALSE(qa.check().has_truth());
  qa.open_truth(truth);  // before there is a case of this image
  open(test, other_case);
  EXPECT_TRUE(qa.check().has_truth());
}

TEST_F(ListsTruth, OfACaseWithoutAnImageIsThatOfTheCase) {
  const fs::path bare = folder / "bare.ostia", other_bare = folder / "bare2.ostia";
  session::CaseFile::create(bare, tube_model());
  session::CaseFile::create(other_bare, tube_model(0.3));
  TestWindow test(state);
  open(test, bare);
  QaDock& qa = test.window().qa();
  qa.show();
  qa.open_truth(truth);
  pull(test);
  rest();
  EXPECT_TRUE(qa.check().has_truth());
  open(test, bare);
  EXPECT_TRUE(qa.check().has_truth());
  open(test, other_bare);
  EXPECT_FALSE(qa.check().has_truth());
}

TEST_F(Lists, AMeasurementStaysUnfoldedAndSelectedWhenTheWallIsEdited) {
  TestWindow test(state);
  open(test, case_file);
  measure(test);
  measure(test);
  auto& shown = list<QTreeWidget>(test, "measurements");
  to_front(shown);
  ASSERT_TRUE(wait_until([&] { return shown.topLevelItemCount() == 2; }));
  QTreeWidgetItem* item = shown.topLevelItem(1);
  ASSERT_GT(item->childCount(), 0);
  item->setExpanded(true);
  shown.setCurrentItem(item->child(0));
  pull(test);
  rest();
  ASSERT_EQ(shown.topLevelItemCount(), 2);
  EXPECT_TRUE(shown.topLevelItem(1)->isExpanded());
  EXPECT_FALSE(shown.topLevelItem(0)->isExpanded());
  EXPECT_EQ(shown.currentItem(), shown.topLevelItem(1)->child(0));
  const auto first = test.bench().session().file().annotations()->measurements.front().id;
  test.bench().annotate(session::MeasureDelete{first});
  ASSERT_TRUE(wait_until([&] { return shown.topLevelItemCount() == 1; }));
  EXPECT_TRUE(shown.topLevelItem(0)->isExpanded());
}

TEST_F(Lists, ANameThatIsBeingTypedIsLeftAlone) {
  TestWindow test(state);
  open(test, case_file);
  measure(test);
  rest();
  test.bench().vessel.set(tube);
  for (const char* name : {"vessels", "measurements"}) {
    auto& shown = list<QTreeWidget>(test, name);
    to_front(shown);
    focus(test, shown);
    shown.setCurrentItem(shown.topLevelItem(0));
    shown.editItem(shown.topLevelItem(0), 0);
    QLineEdit* editor = editor_of(shown);
    ASSERT_TRUE(editor) << name;
    editor->clear();
    QTest::keyClicks(editor, "first ");
    pull(test);
    if (auto* vessels = qobject_cast<VesselList*>(&shown)) vessels->refresh();
    rest();
    ASSERT_EQ(shown.viewport()->findChild<QLineEdit*>(), editor) << name;
    QTest::keyClicks(editor, "second");
    EXPECT_EQ(editor->text(), "first second") << name;
    QTest::keyClick(editor, Qt::Key_Return);
    rest();
    EXPECT_EQ(shown.topLevelItem(0)->text(0), "first second") << name;
  }
  EXPECT_EQ(test.bench().vessel_name(tube), "first second");
  EXPECT_EQ(test.bench().session().file().annotations()->measurements.front().name, "first second");
}

TEST_F(Lists, ANameThatIsBeingTypedIsNotForAnotherCase) {
  TestWindow test(state);
  open(test, case_file);
  auto& shown = list<QTreeWidget>(test, "vessels");
  to_front(shown);
  focus(test, shown);
  shown.setCurrentItem(shown.topLevelItem(0));
  shown.editItem(shown.topLevelItem(0), 0);
  QLineEdit* editor = editor_of(shown);
  ASSERT_TRUE(editor);
  QTest::keyClicks(editor, "of a");
  open(test, other_case);
  EXPECT_EQ(test.bench().vessel_name(tube), "LAD");
  EXPECT_EQ(shown.topLevelItem(0)->text(0), "LAD");
  EXPECT_TRUE(test.bench().session().file().edits().empty());
}

TEST_F(Lists, SegmentsStayUnfoldedWhenTheTreeChanges) {
  TestWindow test(state);
  open(test, case_file);
  auto& shown = list<VesselList>(test, "vessels");
  ASSERT_GT(shown.topLevelItem(0)->childCount(), 0);
  shown.topLevelItem(0)->setExpanded(true);
  test.bench().edit(lumen::AxisTrim{tube, 30.0});
  rest();
  EXPECT_TRUE(shown.topLevelItem(0)->isExpanded());
  test.bench().edit(lumen::BranchSplit{tube, 15.0, {}});
  ASSERT_EQ(shown.topLevelItemCount(), 2);
  EXPECT_TRUE(shown.topLevelItem(0)->isExpanded());
  EXPECT_EQ(shown.topLevelItem(1)->text(0), "LAD distal");
  test.bench().undo();
  ASSERT_EQ(shown.topLevelItemCount(), 1);
  EXPECT_TRUE(shown.topLevelItem(0)->isExpanded());
}

TEST_F(Lists, TheMenuRenamesTheVesselThatItWasOpenedFor) {
  TestWindow test(state);
  open(test, case_file);
  auto& shown = list<VesselList>(test, "vessels");
  to_front(shown);
  focus(test, shown);
  shown.setCurrentItem(shown.topLevelItem(0));
  QTimer::singleShot(200, [&] {
    auto* menu = qobject_cast<QMenu*>(QApplication::activePopupWidget());
    ASSERT_TRUE(menu);
    test.bench().edit(lumen::BranchSplit{tube, 15.0, {}});  // meanwhile
    menu->setActiveAction(menu->actions().first());
    QTest::keyClick(menu, Qt::Key_Return);
  });
  QContextMenuEvent asked(QContextMenuEvent::Keyboard, QPoint(5, 5), shown.mapToGlobal(QPoint(5, 5)));
  QApplication::sendEvent(&shown, &asked);
  QLineEdit* editor = editor_of(shown);
  ASSERT_TRUE(editor);
  EXPECT_EQ(editor->text(), "LAD");
}

TEST_F(Lists, ReturnGoesToAStepAndToAMeasurement) {
  TestWindow test(state);
  open(test, case_file);
  pull(test);
  pull(test);
  auto& steps = list<StepList>(test, "steps");
  to_front(steps);
  ASSERT_TRUE(wait_until([&] { return steps.count() == 3; }));
  const auto marked = [&] {
    std::vector<int> rows;
    for (int row = 0; row < steps.count(); ++row)
      if (steps.item(row)->font().bold()) rows.push_back(row);
    return rows;
  };
  EXPECT_EQ(marked(), std::vector<int>{2});
  focus(test, steps);
  QTest::keyClick(&steps, Qt::Key_Up);
  EXPECT_EQ(steps.currentRow(), 1);
  EXPECT_EQ(marked(), std::vector<int>{2});  // still the step that the case is at
  steps.clearFocus();
  EXPECT_EQ(steps.currentRow(), 2);
  focus(test, steps);
  QTest::keyClick(&steps, Qt::Key_Up);
  QTest::keyClick(&steps, Qt::Key_Return);
  rest();
  EXPECT_EQ(test.bench().session().file().edits().size(), 1U);
  EXPECT_EQ(steps.currentRow(), 1);
  EXPECT_EQ(marked(), std::vector<int>{1});

  measure(test);
  auto& measurements = list<QTreeWidget>(test, "measurements");
  to_front(measurements);
  ASSERT_TRUE(wait_until([&] { return measurements.topLevelItemCount() == 1; }));
  focus(test, measurements);
  measurements.setCurrentItem(measurements.topLevelItem(0));
  test.bench().place.set({0.0, 0.0, 30.0});
  QTest::keyClick(&measurements, Qt::Key_Return);
  EXPECT_LT((test.bench().place.get() - geometry::Vec3(0.0, 0.0, 5.0)).norm(), 1e-6);
}

TEST_F(Lists, StepsHaveTheirVesselTimeAndAuthorAndAreFiltered) {
  TestWindow test(state);
  open(test, case_file);
  pull(test);
  test.bench().session().file().set_author("Dr. A");
  test.bench().edit(lumen::VesselRename{tube, "LAD two"});
  auto& steps = list<StepList>(test, "steps");
  to_front(steps);
  ASSERT_TRUE(wait_until([&] { return steps.count() == 3; }));
  const auto said = [&](int row) { return steps.item(row)->data(Qt::AccessibleTextRole).toString(); };
  const QString today = QTime::currentTime().toString("HH:");
  EXPECT_TRUE(said(1).startsWith("Pull the wall, LAD two")) << said(1).toStdString();
  EXPECT_TRUE(said(1).contains(today)) << said(1).toStdString();
  EXPECT_FALSE(said(1).contains("Dr. A"));
  EXPECT_TRUE(said(2).endsWith("Dr. A")) << said(2).toStdString();
  EXPECT_FALSE(said(0).contains("LAD"));
  auto& line = *test.window().findChild<QLineEdit*>("steps_filter");
  focus(test, line);
  QTest::keyClicks(&line, "dr. rename");
  EXPECT_TRUE(steps.item(0)->isHidden());
  EXPECT_TRUE(steps.item(1)->isHidden());
  EXPECT_FALSE(steps.item(2)->isHidden());
  pull(test);  // the filter stays
  ASSERT_TRUE(wait_until([&] { return steps.count() == 4; }));
  EXPECT_TRUE(steps.item(3)->isHidden());
  line.clear();
  EXPECT_FALSE(steps.item(3)->isHidden());
  focus(test, line);
  QTest::keyClick(&line, Qt::Key_Return);
  EXPECT_TRUE(steps.hasFocus());
  QTest::keyClick(&steps, Qt::Key_Home);
  QTest::keyClick(&steps, Qt::Key_Return);
  EXPECT_TRUE(wait_until([&] { return test.bench().session().file().edits().empty(); }));
}

TEST_F(Lists, TheVesselsNameCanBeReadHoweverNarrowTheListIs) {
  TestWindow test(state);
  open(test, case_file);
  auto& shown = list<VesselList>(test, "vessels");
  const int least = 10 * shown.fontMetrics().averageCharWidth();
  for (const int characters : {60, 30, 24, 18, 12}) {
    shown.setMinimumWidth(0);
    shown.setFixedWidth(characters * shown.fontMetrics().averageCharWidth());
    testing::let_work(100);
    EXPECT_GE(shown.columnWidth(0), least) << characters;
    EXPECT_EQ(shown.isColumnHidden(2), characters < 60) << characters;
  }
}

}  // namespace
}  // namespace ostia::workstation
