// The outer wall in the window: switched on in the View menu by the mouse, drawn, found again after an edit.

#include "outer_walls.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QImage>
#include <QMenu>
#include <QMenuBar>
#include <QStatusBar>
#include <QTest>
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
  /// The mouse opens the menu and presses the entry.
  void press_in_menu(const char* id) {
    auto* entry = test->window().findChild<QAction*>(id);
    ASSERT_TRUE(entry);
    QMenuBar* bar = test->window().menuBar();
    for (QAction* title : bar->actions()) {
      if (!title->menu() || !title->menu()->actions().contains(entry)) continue;
      QTest::mouseClick(bar, Qt::LeftButton, {}, bar->actionGeometry(title).center());
      ASSERT_TRUE(wait_until([&] { return title->menu()->isVisible(); }, 5000));
      QTest::mouseClick(title->menu(), Qt::LeftButton, {}, title->menu()->actionGeometry(entry).center());
      ASSERT_TRUE(wait_until([&] { return !title->menu()->isVisible(); }, 5000));
      return;
    }
    FAIL() << "no menu has " << id;
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

TEST_F(OuterWallWindow, ACaseThatIsClosedMeanwhileGetsNothing) {
  press_in_menu("view.outer_wall");
  test->bench().close_case();
  ASSERT_TRUE(wait_until([&] { return !test->window().jobs().any(); }, 60000));
  wait_until([] { return false; }, 600);
  EXPECT_TRUE(board().known().empty());
}

}  // namespace
}  // namespace ostia::workstation
