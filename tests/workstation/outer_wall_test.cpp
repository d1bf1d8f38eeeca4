// The outer wall in the window: switched on in the View menu by the mouse, drawn, found again after an edit.

#include "commands/table.h"
#include "tube_case.h"
#include "vessels/outer_walls.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"
#include "ostia/session/plaque_sampling.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QHelpEvent>
#include <QImage>
#include <QMenu>
#include <QMenuBar>
#include <QStatusBar>
#include <QTest>
#include <QToolTip>
#include <algorithm>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using testing::wait_until;

constexpr double outer_mm = testing::tube_radius_mm + 0.8;  // of the tube in its image

struct OuterWallWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;

  OuterWallWindow() {
    imaging::write_image(image, testing::tube_image());
    session::CaseFile::create(case_file, testing::tube_model(), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
    test->bench().cursor_mm.set(20.0);
  }
  OuterWalls& walls() { return test->window().outer_walls(); }
  session::OuterWallBoard& board() { return walls().board(); }
  /// The mouse opens the menu and presses the entry; one that cannot be used leaves the menu open.
  void press_in_menu(const char* id, bool usable = true) {
    auto* entry = test->window().findChild<QAction*>(id);
    ASSERT_TRUE(entry);
    QMenuBar* bar = test->window().menuBar();
    for (QAction* title : bar->actions()) {
      if (!title->menu() || !title->menu()->actions().contains(entry)) continue;
      QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(title).center());
      ASSERT_TRUE(wait_until([&] { return title->menu()->isVisible(); }, 5000));
      QTest::mouseClick(title->menu(), Qt::LeftButton, {}, title->menu()->actionGeometry(entry).center());
      if (!usable) title->menu()->hide();
      ASSERT_TRUE(wait_until([&] { return !title->menu()->isVisible(); }, 5000));
      return;
    }
    FAIL() << "no menu has " << id;
  }
  /// Half as wide at 20 mm, so that there is plaque and a stenosis.
  void narrow() {
    lumen::SectionContour ring;
    ring.vessel = 4;
    ring.s_mm = 20.0;
    for (int i = 0; i < 24; ++i)
      ring.points.push_back(
          test->bench().axis()->place(20.0, 2.0 * M_PI * i / 24.0, 0.5 * testing::tube_radius_mm));
    test->bench().edit(ring);
  }
  std::vector<view::OverlayLine> lines(const char* picture) {
    std::vector<view::OverlayLine> found;
    for (const view::OverlayLine& line : test->picture(picture).view().overlay().lines)
      if (line.role == view::Role::outer_wall) found.push_back(line);
    return found;
  }
  bool is_known() {
    return wait_until([&] { return board().of_selected() != nullptr && !test->window().jobs().any(); },
                      60000);
  }
  /// Neither grey nor of a line's strong colour alone: everything that has some colour.
  static int tinted_pixels(QWidget& widget) {
    const QImage shown = widget.grab().toImage();
    int count = 0;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) {
        const QColor color = shown.pixelColor(x, y);
        const auto [least, most] = std::minmax({color.red(), color.green(), color.blue()});
        if (most - least > 30) ++count;
      }
    return count;
  }
  static int yellow_pixels(QWidget& widget) {
    const QImage shown = widget.grab().toImage();
    int count = 0;
    for (int y = 0; y < shown.height(); ++y)
      for (int x = 0; x < shown.width(); ++x) {
        const QColor color = shown.pixelColor(x, y);
        if (color.red() > 150 && color.green() > 140 && color.blue() < color.red() - 60 &&
            std::abs(color.red() - color.green()) < 30)
          ++count;
      }
    return count;
  }
};

TEST_F(OuterWallWindow, IsSwitchedOnDrawnFollowsAnEditAndGoesWithItsCase) {
  PictureWidget& section = test->picture("section");
  EXPECT_FALSE(board().shown.get());
  EXPECT_TRUE(lines("section").empty());
  const int before = yellow_pixels(section);
  press_in_menu("view.outer_wall");
  EXPECT_TRUE(board().shown.get());
  ASSERT_TRUE(is_known());

  // A dashed ring about the lumen on the section, two lines on each CPR.
  ASSERT_EQ(lines("section").size(), 1U);
  const view::OverlayLine ring = lines("section").front();
  EXPECT_TRUE(ring.dashed);
  for (const geometry::Vec2& px : ring.px) {
    const auto place = section.view().world(px);
    ASSERT_TRUE(place);
    EXPECT_NEAR(place->head<2>().norm(), outer_mm, 0.3);
  }
  EXPECT_GE(lines("cpr1").size(), 2U);
  EXPECT_GE(lines("cpr2").size(), 2U);
  EXPECT_GT(yellow_pixels(section), before + 100);
  EXPECT_TRUE(test->window().statusBar()->currentMessage().contains("Plaque"))
      << test->window().statusBar()->currentMessage().toStdString();

  // An edit: what was known goes at once, and comes again by itself.
  const session::VesselWalls known = *board().of_selected();
  lumen::WallDrag drag;
  drag.vessel = 4;
  drag.from = {testing::tube_radius_mm, 0.0, 20.0};
  drag.to = {testing::tube_radius_mm + 0.3, 0.0, 20.0};
  test->bench().edit(drag);
  EXPECT_FALSE(board().of_selected());
  EXPECT_TRUE(lines("section").empty());
  ASSERT_TRUE(is_known());
  EXPECT_NE(board().of_selected()->lumen.radius_mm, known.lumen.radius_mm);
  EXPECT_EQ(lines("section").size(), 1U);

  press_in_menu("view.outer_wall");
  EXPECT_TRUE(lines("section").empty());
  EXPECT_TRUE(lines("cpr1").empty());
  test->bench().close_case();
  EXPECT_TRUE(board().known().empty());
}

TEST_F(OuterWallWindow, PlaqueIsColouredOnceTheOuterWallIsKnown) {
  narrow();
  PictureWidget& section = test->picture("section");
  auto* entry = test->window().findChild<QAction*>("view.plaque");
  ASSERT_TRUE(entry);
  const auto tints = [&](const char* picture) {
    return test->picture(picture).view().overlay().tints.size();
  };
  // Nothing is known: the entry cannot be pressed and says why, in the menu and in the status line.
  EXPECT_FALSE(entry->isEnabled());
  EXPECT_FALSE(entry->isChecked());
  const QString why = entry->statusTip();
  EXPECT_TRUE(why.contains("Outer wall")) << why.toStdString();
  EXPECT_TRUE(entry->toolTip().contains(why));
  press_in_menu("view.plaque", false);
  EXPECT_FALSE(board().plaque_shown.get());

  press_in_menu("view.outer_wall");
  ASSERT_TRUE(is_known());
  EXPECT_TRUE(entry->isEnabled());
  EXPECT_NE(entry->statusTip(), why);
  EXPECT_EQ(tints("section"), 0U);
  const int before = tinted_pixels(section);
  press_in_menu("view.plaque");
  EXPECT_TRUE(entry->isChecked());
  for (const char* picture : {"section", "strip-2", "strip-1", "strip1", "strip2", "cpr1", "cpr2"})
    EXPECT_EQ(tints(picture), 1U) << picture;
  EXPECT_EQ(tints("slice"), 0U);
  EXPECT_GT(tinted_pixels(section), before + 1000);

  // The grey values stay: what was brighter is brighter still.
  EXPECT_LT(section.view().overlay().tints.front()->opacity, 0.6);

  // The key switches it off and on, in both schemes the same.
  for (const ShortcutScheme scheme : {ShortcutScheme::pacs, ShortcutScheme::research})
    EXPECT_EQ(test->window().commands().keys().in_scheme(scheme).keys("view.plaque"),
              QList<QKeySequence>{QKeySequence("Shift+P")});
  test->window().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&test->window()));
  section.setFocus();
  QTest::keyClick(&section, Qt::Key_P, Qt::ShiftModifier);
  EXPECT_EQ(tints("section"), 0U);
  QTest::keyClick(&section, Qt::Key_P, Qt::ShiftModifier);
  EXPECT_EQ(tints("section"), 1U);

  // It comes back after an edit, also without the wall's lines.
  press_in_menu("view.outer_wall");
  EXPECT_TRUE(lines("section").empty());
  EXPECT_EQ(tints("section"), 1U);
  lumen::WallDrag drag;
  drag.vessel = 4;
  drag.from = {testing::tube_radius_mm, 0.0, 20.0};
  drag.to = {testing::tube_radius_mm + 0.1, 0.0, 20.0};
  test->bench().edit(drag);
  EXPECT_EQ(tints("section"), 0U);
  EXPECT_FALSE(entry->isEnabled());
  ASSERT_TRUE(is_known());
  EXPECT_TRUE(entry->isEnabled());
  EXPECT_EQ(tints("section"), 1U);
}

TEST_F(OuterWallWindow, AStenosisTellsItsPlaque) {
  narrow();
  auto* profile = test->window().findChild<ProfileWidget*>("profile");
  ASSERT_TRUE(profile);
  const auto& known = test->bench().stenoses(4);
  ASSERT_FALSE(known.empty());
  const auto tip = [&] {
    const QPoint at(static_cast<int>(profile->view().x_of(known.front().throat_mm)), profile->height() / 2);
    QHelpEvent asked(QEvent::ToolTip, at, profile->mapToGlobal(at));
    QApplication::sendEvent(profile, &asked);
    return QToolTip::text();
  };
  EXPECT_TRUE(tip().contains("View > Outer wall")) << tip().toStdString();
  press_in_menu("view.outer_wall");
  ASSERT_TRUE(is_known());
  const QString told = tip();
  for (const char* part :
       {"Stenosis", "plaque", "low attenuation", "calcified", "burden", "remodelling index"})
    EXPECT_TRUE(told.contains(part)) << part << ": " << told.toStdString();
  const auto plaque = session::plaque_of(*board().of_selected(), known.front());
  ASSERT_TRUE(plaque);
  EXPECT_TRUE(told.contains(QString::number(plaque->volumes.plaque_mm3(), 'f', 1))) << told.toStdString();
  // In the status line when the cursor comes there.
  test->bench().cursor_mm.set(5.0);
  test->window().statusBar()->clearMessage();
  test->bench().cursor_mm.set(known.front().throat_mm);
  EXPECT_TRUE(test->window().statusBar()->currentMessage().contains("remodelling index"))
      << test->window().statusBar()->currentMessage().toStdString();
  // And the profile has the outer wall's line.
  const auto& shown = profile->view().overlay().lines;
  EXPECT_TRUE(std::any_of(shown.begin(), shown.end(),
                          [](const view::OverlayLine& line) { return line.role == view::Role::outer_wall; }));
}

TEST_F(OuterWallWindow, ACaseThatIsClosedMeanwhileGetsNothing) {
  press_in_menu("view.outer_wall");
  test->bench().close_case();
  ASSERT_TRUE(wait_until([&] { return !test->window().jobs().any(); }, 60000));
  testing::let_work(600);
  EXPECT_TRUE(board().known().empty());
}

}  // namespace
}  // namespace ostia::workstation
