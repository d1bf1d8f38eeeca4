// Walks through the window: one that is written is walked, one that a hand made is walked again to the same
// model, and one that cannot go on says where and why.

#include "qa/walk_player.h"
#include "qa/walk_recorder.h"
#include "shell/main_window_walks.h"
#include "tube_window.h"

#include "ostia/core/files.h"

#include <gmock/gmock.h>

#include <QImage>
#include <QWheelEvent>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::AllOf;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using testing::wait_until;

constexpr double narrowing = 0.5;
constexpr int walk_ms = 120000;

struct WalkWindow : testing::TubeWindow {
  const fs::path out = folder / "walked";
  WalkWindow() : TubeWindow(narrowing) {}
  /// Why it ended early.
  std::string walk(const std::string& text) {
    const fs::path file = folder / "test.walk";
    core::write_file(file, text);
    bool ended = false;
    std::string why;
    begin_walk(window(), file, out, [&](const QString& failure) {
      why = failure.toStdString();
      ended = true;
    });
    EXPECT_TRUE(wait_until([&] { return ended; }, walk_ms));
    return why;
  }
  std::size_t edits() { return test->bench().session().file().edits().size(); }
  std::vector<double> diameters() {
    std::vector<double> all;
    for (double s = 2.0; s < 38.0; s += 1.0)
      all.push_back(test->bench().section(test->bench().vessel.get(), s)->diameter_mm);
    return all;
  }
};

TEST_F(WalkWindow, AWrittenOneIsWalkedLookedAtAndMeasured) {
  open_case();
  const std::string why = walk(
      "command view.root\n"
      "expect vessels = 1\n"
      "expect edits = 0\n"
      "command view.next_lesion\n"
      "wheel slice 0.5,0.5 3\n"
      "command tool.drag\n"
      "drag section wall wall+9,0\n"
      "expect edits = 1\n"
      "look pulled\n"
      "command edit.undo\n"
      "expect edits = 0\n"
      "expect complaints = 0\n");
  EXPECT_EQ(why, "");
  const QImage picture(QString::fromStdString((out / "pulled.png").string()));
  EXPECT_EQ(picture.size(), window().size());
  const std::string table = core::read_file(out / "walk.csv");
  EXPECT_EQ(std::count(table.begin(), table.end(), '\n'), 14);
  EXPECT_THAT(table, HasSubstr("\n0,opening,"));
  EXPECT_THAT(table, HasSubstr("7,\"drag section wall wall+9,0\","));
}

TEST_F(WalkWindow, WhatAHandMadeIsMadeAgain) {
  open_case();
  const fs::path before = folder / "before.ostia", recorded = folder / "hand.walk";
  test->bench().session().file().copy_to(before);
  {
    WalkRecorder recorder(window().commands(), recorded);
    QApplication::setActiveWindow(&window());  // keys reach commands of the active window alone
    test->picture("section").setFocus();
    QTest::keyClick(window().windowHandle(), Qt::Key_E);  // the key of tool.drag
    PictureWidget& section = test->picture("section");
    const auto middle = section.view().project(test->bench().place.get());
    const auto wall = section.view().wall_near(middle->px, 200.0);
    ASSERT_TRUE(wall);
    const QPoint from = (QPointF(wall->px.x(), wall->px.y()) / section.devicePixelRatioF()).toPoint();
    testing::sweep(section, {from, from + QPoint(3, 1), from + QPoint(9, 2)});
    settle();
    const QPoint middle_px = section.rect().center();
    QWheelEvent wheel(middle_px, section.mapToGlobal(middle_px), {}, {0, 240}, Qt::NoButton, Qt::NoModifier,
                      Qt::NoScrollPhase, false);
    QApplication::sendEvent(&section, &wheel);
    settle();
    part<QAction>("view.turn_left")->trigger();
    settle();
  }
  ASSERT_EQ(edits(), 1U);
  const std::string text = core::read_file(recorded);
  EXPECT_THAT(text, AllOf(HasSubstr("command tool.drag\n"), HasSubstr("drag section "),
                          HasSubstr("wheel section "), HasSubstr("command view.turn_left\n")));
  const std::vector<double> made = diameters();
  const double angle = test->bench().theta_deg.get(), cursor = test->bench().cursor_mm.get();
  test.reset();
  case_file = before;
  open_case();
  ASSERT_EQ(edits(), 0U);
  EXPECT_EQ(walk(text), "");
  EXPECT_EQ(edits(), 1U);
  // A walk's places are those of pixels; recordings of the hand alone are the same to the last bit.
  EXPECT_THAT(diameters(), ::testing::Pointwise(::testing::DoubleNear(1e-3), made));
  EXPECT_EQ(test->bench().theta_deg.get(), angle);
  EXPECT_EQ(test->bench().cursor_mm.get(), cursor);
}

TEST_F(WalkWindow, ADoubleClickIsWrittenAsOneStep) {
  open_case();
  const fs::path recorded = folder / "hand.walk";
  {
    WalkRecorder recorder(window().commands(), recorded);
    PictureWidget& slice = test->picture("slice");
    const QPoint at = slice.rect().center();
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease,
                                    QEvent::MouseButtonDblClick, QEvent::MouseButtonRelease})
      testing::send(slice, type, at, Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton);
    for (const QEvent::Type type : {QEvent::MouseButtonPress, QEvent::MouseButtonRelease})
      testing::send(slice, type, at, Qt::LeftButton,
                    type == QEvent::MouseButtonRelease ? Qt::NoButton : Qt::LeftButton);
  }
  std::vector<WalkStep::Kind> kinds;
  for (const WalkStep& step : read_walk(recorded)) kinds.push_back(step.kind);
  EXPECT_THAT(kinds, ::testing::ElementsAre(WalkStep::Kind::double_click, WalkStep::Kind::click));
}

TEST_F(WalkWindow, OneThatCannotGoOnSaysWhereAndWhy) {
  open_case();
  EXPECT_THAT(walk("look a\ncommand view.nowhere\n"), AllOf(HasSubstr("line 2"), HasSubstr("view.nowhere")));
  EXPECT_THAT(walk("command edit.undo\n"), AllOf(HasSubstr("line 1"), HasSubstr("not enabled")));
  EXPECT_THAT(walk("click elsewhere 0.5,0.5\n"), HasSubstr("no elsewhere"));
  EXPECT_THAT(walk("look a\nlook b\nexpect vessels >= 2\n"),
              AllOf(HasSubstr("line 3"), HasSubstr("vessels is 1")));
  EXPECT_THAT(walk("expect beauty >= 2\n"), AllOf(HasSubstr("beauty"), HasSubstr("vessels")));
  EXPECT_THAT(walk("file report\n"), HasSubstr("no file dialog"));
  EXPECT_THAT(walk("click profile cursor\n"), HasSubstr("no view of the image"));
  EXPECT_EQ(edits(), 0U);
  EXPECT_TRUE(fs::exists(out / "walk.csv"));
}

TEST_F(WalkWindow, WhatStandsBehindADialogIsNotReached) {
  open_case();
  window().complain("Something is wrong.");
  EXPECT_THAT(walk("expect complaints = 1\nclick section 0.5,0.5\n"),
              AllOf(HasSubstr("line 2"), HasSubstr("behind a dialog")));
}

}  // namespace
}  // namespace ostia::workstation
