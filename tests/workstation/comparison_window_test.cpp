// Two scans of one patient in the window: chosen by a key, one cursor through both, blinked, the new lesion
// found in the list, taken into the report; a former case of another patient is refused, and none of it
// changes a case.

#include "comparison/along.h"
#include "comparison/comparing.h"
#include "comparison/page.h"
#include "layout_faults.h"
#include "measuring/reporting.h"
#include "tube_window.h"
#include "views/picture_widget.h"
#include "views/scene_widget.h"

#include "ostia/core/files.h"
#include "ostia/session/report_digest.h"
#include "ostia/view/curved_view.h"

#include <gmock/gmock.h>

#include <QComboBox>
#include <QTreeWidget>
#include <cmath>
#include <memory>

namespace ostia::workstation {
namespace {

using ::testing::HasSubstr;
using testing::wait_until;
using testing::fs::path;

const geometry::Vec3 former_place(30.0, -20.0, 5.0);

/// A tube in which there is no lesion yet, elsewhere in the scanner.
lumen::LumenModel tube_before() {
  return testing::tube_model(0.0, former_place);
}

/// LAD and RCA side by side.
lumen::LumenModel tubes_apart(double apart_mm) {
  geometry::VesselTree tree;
  for (int k = 0; k < 2; ++k) {
    geometry::Centerline axis;
    for (int i = 0; i <= 40; ++i) {
      axis.points.push_back({k * apart_mm, 0.0, 0.5 * i});
      axis.radius.push_back(1.5);
    }
    geometry::complete(axis);
    tree.nodes.push_back({10 * k + 1, axis.points.front()});
    tree.nodes.push_back({10 * k + 2, axis.points.back()});
    tree.segments.push_back({10 * k + 3, 10 * k + 1, 10 * k + 2, axis});
    tree.vessels.push_back({10 * k + 4, k == 0 ? "LAD" : "RCA", {10 * k + 3}});
  }
  return lumen::model_of_tubes(tree);
}

/// The case on the table has a narrowing by a half, 24 mm from the ostium.
struct ComparisonWindow : testing::TubeWindow {
  path former_image = folder / "former.nrrd", former_case = folder / "former.ostia";

  ComparisonWindow() : TubeWindow(0.5) {
    imaging::write_image(former_image, testing::tube_image(0.0, former_place));
    session::CaseFile::create(former_case, tube_before(), session::image_reference(former_image));
  }
  void know_former_image() {
    session::MachineState(folder / "state")
        .remember_image(session::image_reference(former_image).sha256, former_image);
  }
  Comparing& comparing() { return window().comparing(); }
  session::Workbench& before() { return comparing().former(); }
  void key(int key, Qt::KeyboardModifiers modifiers = {}) {
    QApplication::setActiveWindow(&window());
    QTest::keyClick(window().windowHandle(), static_cast<Qt::Key>(key), modifiers);
    QApplication::processEvents();
  }
  void choose(const path& file) {
    testing::answer_file_dialog(file);
    key(Qt::Key_B, Qt::ControlModifier | Qt::AltModifier);
  }
  void compare() {
    know_former_image();
    open_case();
    choose(former_case);
    ASSERT_TRUE(wait_until([&] { return comparing().made() && idle(); }, 60000));
    settle();
  }
  QTreeWidget& lesions() { return *part<QTreeWidget>("compared_lesions"); }
  PictureWidget& picture(const char* name) { return *part<PictureWidget>(name); }
  double row_of_cursor(const char* name, session::Workbench& bench) {
    auto& view = dynamic_cast<view::CurvedView&>(picture(name).view());
    return view.row_of(bench.cursor_mm.get());
  }
  std::string state() { return part<QLabel>("compared_state")->text().toStdString(); }
};

TEST_F(ComparisonWindow, OneCursorGoesThroughBothScansWhicheverIsMoved) {
  compare();
  ASSERT_TRUE(part<QWidget>("comparison_page")->isVisible());
  EXPECT_FALSE(window().centralWidget()->isVisible());
  EXPECT_THAT(state(), HasSubstr("1 in both")) << "its plaque was there before";
  ASSERT_EQ(lesions().topLevelItemCount(), 1);
  const QStringList diameters = lesions().topLevelItem(0)->text(3).split(QStringLiteral(" \u2192 "));
  ASSERT_EQ(diameters.size(), 2);
  EXPECT_NEAR(diameters[0].toDouble(), 2.0 * testing::tube_radius_mm, 0.1);
  EXPECT_NEAR(diameters[1].toDouble(), testing::tube_radius_mm, 0.1);

  // The list leads both to the narrowing.
  key(Qt::Key_I);
  settle();
  EXPECT_NEAR(test->bench().cursor_mm.get(), testing::throat_mm, 1.0);
  EXPECT_NEAR(before().cursor_mm.get(), test->bench().cursor_mm.get(), 0.5);
  EXPECT_LT((before().place.get() - test->bench().place.get() - former_place).norm(), 0.5);
  EXPECT_NEAR(row_of_cursor("compared_cpr_now", test->bench()),
              row_of_cursor("compared_cpr_before", before()), 1.0);
  const QImage kept = testing::on_screen(window(), "comparison");
  EXPECT_FALSE(kept.isNull());
  EXPECT_EQ(testing::layout_faults(window()).join('\n').toStdString(), "");

  // A click in the former CPR, a wheel over the former section, a click beside the vessel in a slice.
  PictureWidget& cpr = picture("compared_cpr_before");
  QTest::mouseClick(&cpr, Qt::LeftButton, {}, QPoint(cpr.width() / 2, cpr.height() / 3));
  settle();
  EXPECT_LT(test->bench().cursor_mm.get(), testing::throat_mm - 1.0);
  EXPECT_NEAR(before().cursor_mm.get(), test->bench().cursor_mm.get(), 0.5);
  const double last = test->bench().cursor_mm.get();
  PictureWidget& section = picture("compared_section_before");
  QWheelEvent wheel(section.rect().center(), section.mapToGlobal(section.rect().center()), {}, {0, -240},
                    Qt::NoButton, Qt::NoModifier, Qt::NoScrollPhase, false);
  QApplication::sendEvent(&section, &wheel);
  settle();
  EXPECT_NEAR(test->bench().cursor_mm.get(), last + 1.0, 0.3);
  PictureWidget& slice = picture("compared_slice_now");
  const QPoint middle = slice.rect().center();
  QTest::mouseClick(&slice, Qt::LeftButton, {}, middle + QPoint(30, 10));
  settle();
  // How the straight tube is turned about itself nobody can know.
  const geometry::Vec3 is = test->bench().place.get(), was = before().place.get() - former_place;
  EXPECT_GT(std::hypot(is.x(), is.y()), 1.0);
  EXPECT_NEAR(std::hypot(was.x(), was.y()), std::hypot(is.x(), is.y()), 0.3);
  EXPECT_NEAR(was.z(), is.z(), 0.5);

  // A key shows one scan in the place of the other.
  PictureWidget &now = picture("compared_cpr_now"), &then = picture("compared_cpr_before");
  EXPECT_TRUE(now.isVisible() && then.isVisible());
  key(Qt::Key_Z);
  settle();
  ASSERT_TRUE(then.isVisible());
  EXPECT_FALSE(now.isVisible());
  const QRect shown_at(then.mapToGlobal(QPoint()), then.size());
  key(Qt::Key_Z);
  settle();
  ASSERT_TRUE(now.isVisible());
  EXPECT_FALSE(then.isVisible());
  EXPECT_EQ(QRect(now.mapToGlobal(QPoint()), now.size()), shown_at);
  EXPECT_NEAR(row_of_cursor("compared_cpr_now", test->bench()),
              row_of_cursor("compared_cpr_before", before()), 1.0);
  key(Qt::Key_Z, Qt::ShiftModifier);
  settle();
  EXPECT_TRUE(now.isVisible() && then.isVisible());

  // The diameter along the vessel is that of both tubes.
  auto* along = part<AlongWidget>("compared_along");
  ASSERT_FALSE(along->places().empty());
  double worst = 0.0;
  for (const ComparedPlace& place : along->places()) {
    if (place.now_mm < 3.0 || place.now_mm > 37.0) continue;
    const auto change = place.diameter.change();
    ASSERT_TRUE(change);
    const double made = 2.0 * (testing::tube_radius(place.now_mm, 0.5) - testing::tube_radius_mm);
    worst = std::max(worst, std::abs(*change - made));
  }
  EXPECT_LT(worst, 0.15);
  QTest::mouseClick(along, Qt::LeftButton, {}, QPoint(static_cast<int>(along->x_of(10.0)), 40));
  EXPECT_NEAR(test->bench().cursor_mm.get(), 10.0, 0.1);
  QTest::keyClick(along, Qt::Key_Right);
  EXPECT_NEAR(test->bench().cursor_mm.get(), 10.5, 0.1);
}

TEST_F(ComparisonWindow, TheFormerWallStandsOutWhereTheVesselWasWider) {
  compare();
  view::TreeScene& scene = window().scene().scene();
  scene.set_pose(view::pose_from(view::ViewFrom::anterior, {0.0, 0.0, testing::throat_mm}, 10.0));
  // Between the throat's wall, half as wide as before, and the former one.
  const auto blue = [&] {
    const figure::Raster shot = scene.snapshot(400, 400);
    const std::size_t x = 200 + static_cast<std::size_t>(0.8 * testing::tube_radius_mm * 20.0);
    const std::size_t at = 4 * (200 * 400 + x);
    return shot.rgba[at + 2] - shot.rgba[at];
  };
  EXPECT_LT(blue(), 15);
  part<QAction>("compare.in_3d")->trigger();
  settle();
  EXPECT_TRUE(window().centralWidget()->isVisible()) << "the views are there again";
  EXPECT_GT(blue(), 20);
  part<QAction>("compare.close")->trigger();
  settle();
  EXPECT_FALSE(part<QAction>("compare.in_3d")->isChecked());
  EXPECT_LT(blue(), 15);
}

TEST_F(ComparisonWindow, NoCaseIsChangedAndAnEditMakesTheComparisonOld) {
  const std::string file = core::sha256_file(former_case);
  compare();
  const auto& cases = test->bench().session().file();
  const std::string digest = session::report_digest(cases);
  EXPECT_FALSE(before().session().file().editable());
  part<QAction>("compare.report")->trigger();
  EXPECT_EQ(window().reporting().pinned(), 2U) << "the lesions, and LAD";
  EXPECT_EQ(session::report_digest(cases), digest);
  EXPECT_EQ(core::sha256_file(former_case), file);

  lumen::WallDrag drag;
  drag.vessel = 4;
  drag.from = {1.5, 0.0, 12.0};
  drag.to = {2.0, 0.0, 12.0};
  test->bench().edit(drag);
  EXPECT_TRUE(comparing().outdated.get());
  EXPECT_THAT(state(), HasSubstr("Out of date"));
  part<QAction>("compare.again")->trigger();
  ASSERT_TRUE(wait_until([&] { return !comparing().outdated.get() && idle(); }, 60000));
  part<QAction>("compare.close")->trigger();
  EXPECT_FALSE(before().has_case());
  EXPECT_TRUE(window().centralWidget()->isVisible());
}

TEST_F(ComparisonWindow, AnotherPatientIsRefusedUnlessAPersonKnowsBetter) {
  session::CaseFile::create(folder / "now.ostia", tubes_apart(60.0));
  session::CaseFile::create(folder / "another.ostia", tubes_apart(15.0));
  test = std::make_unique<testing::TestWindow>(folder / "state");
  test->open(folder / "now.ostia");
  choose(folder / "another.ostia");
  ASSERT_TRUE(wait_until([] { return !testing::open_boxes().empty(); }, 60000));
  QMessageBox* box = testing::open_boxes().front();
  EXPECT_EQ(box->objectName().toStdString(), "comparison_doubt");
  EXPECT_FALSE(comparing().made());
  for (QAbstractButton* button : box->buttons())
    if (box->buttonRole(button) == QMessageBox::AcceptRole) QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return comparing().made() != nullptr; }));
  EXPECT_FALSE(comparing().made()->another_patient.empty());
}

TEST_F(ComparisonWindow, AnImageThatIsNotKnownIsAskedFor) {
  open_case();
  choose(former_case);
  ASSERT_TRUE(wait_until([] { return !testing::open_boxes().empty(); }, 60000));
  QMessageBox* box = testing::open_boxes().front();
  ASSERT_EQ(box->objectName().toStdString(), "comparison_image");
  testing::answer_file_dialog(former_image);
  for (QAbstractButton* button : box->buttons())
    if (button->text().contains("file")) QTest::mouseClick(button, Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return comparing().made() && idle(); }, 60000));
  EXPECT_TRUE(before().image().volume);
}

}  // namespace
}  // namespace ostia::workstation
