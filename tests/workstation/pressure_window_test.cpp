// Pressures in the window: a wall is pulled by the mouse of the X server and FFR crosses 0.80 beside it; what
// if, inputs, the report; and nothing of it without the sentence on research use.

#include "layout_faults.h"
#include "measuring/lesion_list.h"
#include "measuring/lesion_texts.h"
#include "painted_faults.h"
#include "pressure/inputs.h"
#include "pressure/live.h"
#include "pressure/page.h"
#include "real_program.h"
#include "shell/language.h"
#include "tube_window.h"

#include "ostia/view/curved_view.h"

#include <gmock/gmock.h>

#include <QStandardPaths>
#include <QTabWidget>
#include <QTranslator>
#include <QTreeWidget>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::wait_until;
using testing::xdo;
using view::Role;

constexpr double behind_mm = 38.0;

struct PressureWindow : testing::TubeWindow {
  /// 62 % of the diameter at 24 mm: above 0.80.
  static constexpr double narrowing = 0.62;
  PressureWindow() : TubeWindow(narrowing) {
    open_case();
    window().move(0, 0);
    window().activateWindow();
    settle();
  }
  ~PressureWindow() override { xdo({"mouseup", "1"}); }
  void show_pressures() {
    part<QAction>("view.pressure")->trigger();
    ASSERT_TRUE(is_known());
    test->bench().cursor_mm.set(behind_mm);
    settle();
  }
  bool is_known() {
    return wait_until([&] { return pressures().board().now() && pressures().idle(); }, 60000);
  }
  Pressures& pressures() { return window().pressures(); }
  QString label() { return part<QLabel>("ffr_at_cursor")->text(); }
  /// "LAD at 38.0 mm: FFR 0.62, what if 0.95": the numbers as a person reads them.
  double shown_ffr() { return label().section("FFR ", 1).section(',', 0, 0).toDouble(); }
  view::CurvedView& curved() { return dynamic_cast<view::CurvedView&>(test->picture("cpr1").view()); }
  QStringList texts(const view::Overlay& overlay, Role role) {
    QStringList found;
    for (const view::OverlayText& one : overlay.texts)
      if (one.role == role) found << QString::fromStdString(one.text);
    return found;
  }
  int lines(const view::Overlay& overlay, Role role) {
    return static_cast<int>(std::count_if(overlay.lines.begin(), overlay.lines.end(),
                                          [&](const view::OverlayLine& one) { return one.role == role; }));
  }
  const view::Overlay& profile() { return part<ProfileWidget>("profile")->view().overlay(); }
  LesionList& list() { return *part<LesionList>("lesions"); }
  QTreeWidgetItem* narrow() {
    for (int i = 0; i < list().topLevelItemCount(); ++i)
      if (list().topLevelItem(i)->text(percent_column).toDouble() > 40.0) return list().topLevelItem(i);
    return nullptr;
  }
  QPoint wall_on_screen(double s_mm, double radius_mm) {
    PictureWidget& cpr = test->picture("cpr1");
    const view::Vec2 px = cpr.view().project(test->bench().axis()->place(s_mm, 0.0, radius_mm)).value().px /
                          cpr.devicePixelRatioF();
    return cpr.mapToGlobal(QPointF(px.x(), px.y()).toPoint());
  }
};

TEST_F(PressureWindow, NoneIsShownBeforeThePageIsOpenAndNoneWithoutItsSentence) {
  EXPECT_TRUE(list().isColumnHidden(ffr_column));
  EXPECT_TRUE(texts(curved().overlay(), Role::pressure).isEmpty());
  EXPECT_EQ(lines(profile(), Role::pressure), 0);
  EXPECT_FALSE(pressures().board().now());
  show_pressures();
  const auto* sentence = part<QLabel>("research_use");
  EXPECT_TRUE(sentence->isVisible());
  EXPECT_THAT(sentence->text().toStdString(), HasSubstr("no decision on a patient may rest on them"));
  EXPECT_FALSE(list().isColumnHidden(ffr_column));
  const QStringList on_cpr = texts(curved().overlay(), Role::pressure);
  ASSERT_FALSE(on_cpr.isEmpty());
  EXPECT_TRUE(on_cpr[0].startsWith("FFR (research) 0.")) << on_cpr[0].toStdString();
  EXPECT_NEAR(on_cpr[0].section(' ', 2, 2).toDouble(), shown_ffr(), 1e-9);
  EXPECT_GE(lines(profile(), Role::pressure), 2) << "the curve and the threshold";
  ASSERT_TRUE(wait_until([&] { return narrow() && narrow()->text(ffr_column) != "?"; }, 60000));
  EXPECT_NEAR(narrow()->text(ffr_column).toDouble(), shown_ffr(), 0.03);
  testing::on_screen(window(), "pressure-page");
  part<QAction>("view.pressure")->trigger();
  settle();
  EXPECT_FALSE(sentence->isVisible());
  EXPECT_TRUE(list().isColumnHidden(ffr_column));
  EXPECT_TRUE(texts(curved().overlay(), Role::pressure).isEmpty());
  EXPECT_EQ(lines(profile(), Role::pressure), 0);
}

TEST_F(PressureWindow, AWallIsPulledAndFfrCrossesTheThresholdBesideTheMouse) {
  if (QStandardPaths::findExecutable("xdotool").isEmpty()) GTEST_SKIP() << "xdotool is not installed";
  show_pressures();
  test->bench().tool.set(session::Tool::drag);
  test->bench().reach_mm.set(1.5);
  const double first = shown_ffr();
  EXPECT_GT(first, 0.80);
  const double radius = (1.0 - narrowing) * testing::tube_radius_mm;
  const QPoint wall = wall_on_screen(testing::throat_mm, radius),
               axis = wall_on_screen(testing::throat_mm, 0.0);
  const int inwards = axis.x() < wall.x() ? -1 : 1;
  testing::go(wall);
  QTest::qWait(60);
  xdo({"mousedown", "1"});
  double least = first;
  std::vector<double> behind;
  const int steps = std::abs(axis.x() - wall.x());
  const auto at_step = [&](int i) {
    testing::go(wall + QPoint(inwards * i, 0));
    QTest::qWait(25);
    wait_until([&] { return !pressures().board().behind(); }, 4000);
    behind.push_back(pressures().last_behind_ms());
    return shown_ffr();
  };
  int there = 0;
  for (; there < steps && least > 0.77; ++there) least = std::min(least, at_step(there + 1));
  EXPECT_LT(least, 0.80) << "the wall was pulled in by " << there << " of " << steps << " pixels";
  testing::on_screen(window(), "pressure-pulled");
  double last = least;
  for (; there > 0; --there) last = at_step(there - 1);
  xdo({"mouseup", "1"});
  settle();
  EXPECT_GT(last, 0.80) << "and back";
  EXPECT_NEAR(last, first, 0.03);
  std::sort(behind.begin(), behind.end());
  RecordProperty("behind_median_ms", std::to_string(behind[behind.size() / 2]));
  RecordProperty("behind_p95_ms", std::to_string(behind[behind.size() * 95 / 100]));
  std::printf("FFR was behind the mouse by %.0f ms (median), %.0f ms (p95) of %zu moves\n",
              behind[behind.size() / 2], behind[behind.size() * 95 / 100], behind.size());
  EXPECT_EQ(test->bench().session().file().edits().size(), 1U) << "one pull, one step";
  ASSERT_TRUE(is_known());
  test->bench().undo();
  ASSERT_TRUE(is_known());
  EXPECT_NEAR(shown_ffr(), first, 0.011);
}

TEST_F(PressureWindow, WhatIfIsAskedByButtonsAndTakenBack) {
  show_pressures();
  const double before = shown_ffr();
  test->bench().cursor_mm.set(testing::throat_mm);
  settle();
  QTest::mouseClick(part<QToolButton>("button.pressure.open"), Qt::LeftButton);
  ASSERT_TRUE(is_known());
  test->bench().cursor_mm.set(behind_mm);
  settle();
  ASSERT_TRUE(label().contains("what if 0.9")) << label().toStdString();
  EXPECT_NEAR(shown_ffr(), before, 1e-9) << "the lumen is as it was";
  EXPECT_EQ(lines(profile(), Role::what_if), 1);
  EXPECT_EQ(texts(curved().overlay(), Role::what_if).size(), 1);
  EXPECT_EQ(part<QTreeWidget>("what_if_stretches")->topLevelItemCount(), 1);
  ASSERT_TRUE(wait_until([&] { return narrow() && narrow()->text(ffr_column).contains(QChar(0x2192)); }));
  EXPECT_EQ(test->bench().session().file().journal().back().op, "pressure.what_if");
  testing::on_screen(window(), "pressure-what-if");
  part<QAction>("edit.undo")->trigger();
  ASSERT_TRUE(is_known());
  settle();
  EXPECT_FALSE(label().contains("what if"));
  part<QAction>("edit.redo")->trigger();
  ASSERT_TRUE(is_known());
  settle();
  EXPECT_TRUE(label().contains("what if"));
  QTest::mouseClick(part<QToolButton>("button.pressure.clear"), Qt::LeftButton);
  ASSERT_TRUE(is_known());
  settle();
  EXPECT_FALSE(label().contains("what if"));
  EXPECT_FALSE(part<QAction>("pressure.clear")->isEnabled());
  // Narrower at a place without a narrowing.
  test->bench().cursor_mm.set(10.0);
  QTest::mouseClick(part<QToolButton>("button.pressure.narrow"), Qt::LeftButton);
  ASSERT_TRUE(is_known());
  EXPECT_LT(*session::ffr_after_at(*pressures().board().now(), 4, behind_mm), before);
}

TEST_F(PressureWindow, InputsAreTypedKeptAndRefused) {
  show_pressures();
  const double before = shown_ffr();
  auto* tabs = part<QTabWidget>("pressure_tabs");
  tabs->setCurrentIndex(1);
  auto* inputs = part<PressureInputs>("pressure_inputs");
  const auto row = [&](const QString& meaning) {
    const auto found = inputs->findItems(meaning, Qt::MatchExactly, PressureInputs::name_column);
    return found.isEmpty() ? nullptr : found.front();
  };
  const auto type_value = [&](QTreeWidgetItem* item, const QString& text) {
    inputs->setCurrentItem(item, PressureInputs::value_column);
    inputs->editItem(item, PressureInputs::value_column);
    auto* editor = inputs->findChild<QLineEdit*>();
    ASSERT_TRUE(editor);
    editor->selectAll();
    QTest::keyClick(editor, Qt::Key_Delete);
    QTest::keyClicks(editor, text);
    QTest::keyClick(editor, Qt::Key_Return);
    QApplication::processEvents();
  };
  EXPECT_EQ(inputs->topLevelItemCount(), static_cast<int>(hemodynamics::condition_inputs().size()));
  QTreeWidgetItem* flow = row("flow of the whole tree at rest");
  ASSERT_TRUE(flow);
  EXPECT_TRUE(flow->text(PressureInputs::value_column).isEmpty());
  EXPECT_EQ(flow->text(PressureInputs::unit_column), "ml/min");
  type_value(flow, "60");
  ASSERT_TRUE(is_known());
  settle();
  testing::on_screen(window(), "pressure-inputs");
  EXPECT_LT(shown_ffr(), before - 0.02);
  EXPECT_EQ(flow->text(PressureInputs::source_column), "given here");
  QTreeWidgetItem* systolic = row("systolic pressure by cuff");
  type_value(systolic, "400");
  settle();
  EXPECT_EQ(systolic->text(PressureInputs::value_column), "120") << "refused";
  type_value(systolic, "many");
  settle();
  EXPECT_EQ(systolic->text(PressureInputs::value_column), "120");
  EXPECT_EQ(test->bench().session().file().annotations()->pressure.inputs.size(), 1u);
  type_value(flow, "");
  ASSERT_TRUE(is_known());
  settle();
  EXPECT_NEAR(shown_ffr(), before, 1e-9) << "the usual one again";
}

TEST_F(PressureWindow, AllOfItCanBeReadInEveryLanguageAndSize) {
  const auto leave = [&] {
    part<QAction>("file.close")->trigger();
    EXPECT_TRUE(wait_until([&] { return !test->bench().has_case(); }));
    test.reset();
  };
  leave();
  for (const Language& language : languages()) {
    use_language(language.code.toStdString());
    for (const QSize& size : {QSize(1600, 1150), QSize(1280, 950)}) {
      open_case(size);
      show_pressures();
      test->bench().cursor_mm.set(testing::throat_mm);
      part<QAction>("pressure.open")->trigger();
      ASSERT_TRUE(is_known());
      settle();
      const std::string where = language.code.toStdString() + " " + std::to_string(size.width());
      for (const int tab : {0, 1}) {
        part<QTabWidget>("pressure_tabs")->setCurrentIndex(tab);
        settle();
        testing::on_screen(window(), QString::fromStdString("pressure-" + where + "-" + std::to_string(tab)));
        const QStringList faults = testing::layout_faults(window()) + testing::painted_faults(window());
        EXPECT_TRUE(faults.isEmpty()) << where << ": " << faults.join('\n').toStdString();
      }
      test->bench().undo();
      part<QAction>("view.pressure")->trigger();  // the next window begins as this one was left
      leave();
    }
  }
  for (QTranslator* one : qApp->findChildren<QTranslator*>()) delete one;
  use_language(std::string("en"));
}

TEST_F(PressureWindow, TheTreeHasTheColoursOfFfrAndTheReportIsBesideTheCase) {
  show_pressures();
  const auto texts_in_3d = [&] {
    QString all;
    for (const auto& one : window().scene().scene().texts()) all += QString::fromStdString(one.text) + "\n";
    return all;
  };
  look_from_front();
  EXPECT_TRUE(texts_in_3d().contains("FFR (research)")) << texts_in_3d().toStdString();
  part<QAction>("pressure.map")->trigger();
  settle();
  EXPECT_FALSE(texts_in_3d().contains("FFR"));
  part<QAction>("pressure.report")->trigger();
  const fs::path made = folder / "tube-pressure";
  ASSERT_TRUE(wait_until([&] { return fs::exists(made / "manifest.json") && idle(); }, 30000));
  for (const char* name : {"pressure.pdf", "pressure.html", "ffr.json", "lines.vtp"})
    EXPECT_TRUE(fs::exists(made / name)) << name;
  EXPECT_THAT(core::read_file(made / "pressure.html"), HasSubstr("no decision on a patient"));
}

}  // namespace
}  // namespace ostia::workstation
