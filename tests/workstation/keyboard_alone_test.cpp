// From an image to its report by keys alone: open, find, walk, correct, grade, report.

#include "kept_scan.h"
#include "measuring/lesions.h"
#include "vessels/evaluability.h"
#include "views/picture_widget.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/case_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QCursor>
#include <QPointer>
#include <QTest>
#include <QWindow>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TestWindow;
using testing::wait_until;

constexpr int found_ms = 240000, report_ms = 240000, answer_ms = 20000;
constexpr int slow_ms = 140;  // apart from each other, keys that move the mouse move it a pixel each

const phantom::Scan& keyboard_patient() {
  static const phantom::Scan scan = [] {
    phantom::CaseOptions options;
    options.preset = phantom::Preset::small;
    return ostia::testing::kept_scan(phantom::plan_case(options));
  }();
  return scan;
}

struct KeyboardAlone : ::testing::Test {
  testing::Folder folder;
  const fs::path image = folder / "heart.nrrd";
  TestWindow test{folder / "state"};

  void SetUp() override {
    imaging::write_image(image, keyboard_patient().image);
    test.window().activateWindow();
    ASSERT_TRUE(QTest::qWaitForWindowActive(&test.window()));
  }
  /// To whatever has the keyboard.
  static void key(int what, Qt::KeyboardModifiers with = Qt::NoModifier) {
    // When a dialog goes, a window manager gives the keyboard back; here nobody does.
    if (!QGuiApplication::focusWindow())
      for (QWidget* window : QApplication::topLevelWidgets())
        if (window->isVisible() && qobject_cast<MainWindow*>(window)) {
          window->activateWindow();
          ASSERT_TRUE(QTest::qWaitForWindowActive(window));
        }
    QWindow* to = QGuiApplication::focusWindow();
    ASSERT_NE(to, nullptr) << "nothing has the keyboard";
    const QPointer<QWindow> there = to;
    QTest::keyPress(to, static_cast<Qt::Key>(what), with);
    if (there) QTest::keyRelease(to, static_cast<Qt::Key>(what), with);  // Escape takes its window away
    QApplication::processEvents();
  }
  session::Workbench& bench() { return test.bench(); }
  const session::CaseFile& file() { return bench().session().file(); }
  std::string vessel() { return bench().vessel_name(bench().vessel.get()); }

  void open_and_find() {
    bool typed = false;
    QTimer::singleShot(600, [&] {
      ASSERT_TRUE(wait_until([] { return QApplication::activeModalWidget() != nullptr; }, answer_ms));
      QTest::keyClicks(QApplication::focusWidget(), QString::fromStdString(image.string()));
      typed = true;
      key(Qt::Key_Return);
    });
    key(Qt::Key_O, Qt::ControlModifier);
    ASSERT_TRUE(typed);
    ASSERT_TRUE(wait_until([&] { return bench().has_case() && !test.window().jobs().any(); }, found_ms));
    ASSERT_GE(bench().model()->tree.vessels.size(), 3U);
    testing::let_rest();
  }
  void walk_to_the_lad() {
    for (std::size_t i = 0; i < bench().model()->tree.vessels.size() && vessel() != "LAD"; ++i)
      key(Qt::Key_Right, Qt::ControlModifier);
    ASSERT_EQ(vessel(), "LAD");
    key(Qt::Key_Home, Qt::ControlModifier);
    const double root = bench().cursor_mm.get();
    for (int i = 0; i < 40; ++i) key(Qt::Key_Down, Qt::ControlModifier);
    EXPECT_GT(bench().cursor_mm.get(), root + 15.0);
    testing::let_rest();
  }
  static void step(const QPoint& way) {
    const bool sideways = std::abs(way.x()) >= std::abs(way.y());
    key(sideways      ? (way.x() > 0 ? Qt::Key_Right : Qt::Key_Left)
        : way.y() > 0 ? Qt::Key_Down
                      : Qt::Key_Up,
        Qt::AltModifier | Qt::ShiftModifier);
  }
  /// The mouse's pointer to a place, to the pixel.
  static void point_at(const QPoint& place) {
    constexpr int near_px = 40, most_steps = 600;
    for (int i = 0; i < most_steps && QCursor::pos() != place; ++i) {
      const QPoint way = place - QCursor::pos();
      if (way.manhattanLength() < near_px) QTest::qWait(slow_ms);
      step(way);
    }
    ASSERT_EQ(QCursor::pos(), place);
  }
  /// The wall on the cross-section, pulled outwards.
  void correct() {
    PictureWidget& section = test.picture("section");
    const double s = bench().cursor_mm.get();
    const double radius = bench().section(bench().vessel.get(), s)->diameter_mm / 2.0;
    const auto on_screen = [&](double out_mm) {
      const auto px = section.view().project(bench().axis()->place(s, 0.0, radius + out_mm))->px;
      return section.mapToGlobal(
          QPoint(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y()))));
    };
    const QPoint wall = on_screen(0.0), beyond = on_screen(0.6);
    const auto edits = file().edits().size();
    key(Qt::Key_E);
    EXPECT_EQ(bench().tool.get(), session::Tool::drag);
    point_at(wall);
    key(Qt::Key_Insert);
    point_at(beyond);
    key(Qt::Key_Insert);
    ASSERT_EQ(file().edits().size(), edits + 1) << "the wall was not pulled";
    EXPECT_GT(bench().section(bench().vessel.get(), s)->diameter_mm, 2.0 * radius + 0.05);
    key(Qt::Key_Escape);
    EXPECT_EQ(bench().tool.get(), session::Tool::browse);
  }
  const session::VesselMark* mark() {
    for (const session::VesselMark& one : file().annotations()->marks)
      if (one.vessel == bench().vessel.get()) return &one;
    return nullptr;
  }
  void grade() {
    ASSERT_TRUE(wait_until([&] { return test.window().evaluability().idle(); }, found_ms));
    key(Qt::Key_2, Qt::ControlModifier);  // evaluable in part
    ASSERT_TRUE(mark());
    ASSERT_EQ(mark()->evaluable.size(), 1U);
    EXPECT_EQ(mark()->evaluable[0].grade, analysis::Evaluability::limited);
    EXPECT_TRUE(mark()->evaluable[0].by_person);
    ASSERT_TRUE(wait_until([&] { return test.window().lesions().idle(); }, found_ms));
    key(Qt::Key_L);  // the next lesion, of whichever vessel
    key(Qt::Key_Y);
    ASSERT_TRUE(mark());
    ASSERT_EQ(mark()->lesions.size(), 1U) << "no lesion was accepted";
    EXPECT_EQ(mark()->lesions[0].state, session::LesionState::accepted);
  }
  fs::path report() {
    key(Qt::Key_R, Qt::ControlModifier);
    const auto said = [&] { return test.window().findChild<QMessageBox*>("report_made"); };
    // Shown, and with the keyboard: a moment lies between.
    EXPECT_TRUE(
        wait_until([&] { return said() && said()->isVisible() && said()->isActiveWindow(); }, report_ms));
    key(Qt::Key_Escape);
    EXPECT_TRUE(wait_until([&] { return !said(); }));
    for (const auto& entry : fs::directory_iterator(folder / "state/cases"))
      if (entry.is_directory()) return entry.path();
    return {};
  }
};

TEST_F(KeyboardAlone, FromAnImageToItsReport) {
  ASSERT_NO_FATAL_FAILURE(open_and_find());
  ASSERT_NO_FATAL_FAILURE(walk_to_the_lad());
  ASSERT_NO_FATAL_FAILURE(correct());
  ASSERT_NO_FATAL_FAILURE(grade());
  const fs::path made = report();
  ASSERT_FALSE(made.empty());
  EXPECT_EQ(core::read_file(made / "report.pdf").substr(0, 5), "%PDF-");
  const std::string html = core::read_file(made / "report.html");
  EXPECT_THAT(html, HasSubstr("wall dragged"));
  EXPECT_THAT(html, HasSubstr("limited (reader)"));
  EXPECT_THAT(html, HasSubstr("accepted"));
  EXPECT_TRUE(fs::exists(made / "manifest.json"));
}

}  // namespace
}  // namespace ostia::workstation
