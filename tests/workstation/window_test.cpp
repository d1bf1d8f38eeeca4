#include "measuring/lesions.h"
#include "measuring/list.h"
#include "measuring/reporting.h"
#include "shell/main_window.h"
#include "shell/panel.h"
#include "shell/step_list.h"
#include "tube_case.h"
#include "vessels/list.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/view/curved_view.h"
#include "ostia/view/plane_view.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QSplitter>
#include <QStatusBar>
#include <QTest>
#include <cmath>
#include <fstream>
#include <map>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using session::Tool;
using testing::message;
using testing::sweep;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;
using view::Vec2;
using view::Vec3;

constexpr double window_radius_mm = testing::tube_radius_mm;

struct WindowTest : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  WindowTest() {
    imaging::write_image(image, tube_image());
    session::CaseFile::create(case_file, tube_model(), session::image_reference(image));
  }
  void know_the_image() {
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
  }
  std::size_t stored_edits() const {
    return session::CaseFile::open(case_file, session::OpenMode::read_only).edits().size();
  }
};

QPoint point(const Vec2& px) {
  return {static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y()))};
}

/// Where the wall is on a CPR, to the right of the axis.
QPoint wall_on(PictureWidget& picture, double s_mm) {
  auto& cpr = static_cast<view::CurvedView&>(picture.view());
  const auto axis = cpr.bench().axis();
  return point(cpr.project(axis->place(s_mm, cpr.theta_deg() * M_PI / 180.0, window_radius_mm))->px);
}

TEST_F(WindowTest, OpensACaseWithItsImageAndShowsAllViews) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  ASSERT_TRUE(test.bench().image().volume);
  for (const char* name : {"cpr1", "cpr2", "section", "slice"}) {
    view::PictureView& view = test.picture(name).view();
    EXPECT_TRUE(view.ready()) << name;
    EXPECT_GT(view.image().width, 50) << name;
    EXPECT_FALSE(view.overlay().lines.empty()) << name;
  }
  EXPECT_EQ(test.window().findChild<VesselList*>("vessels")->topLevelItemCount(), 1);
}

TEST_F(WindowTest, TheMouseEditsOnBothCprsAndOnTheSectionAndUndoTakesItBack) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  const std::string before = lumen::digest(*test.bench().model());
  test.bench().cursor_mm.set(20.0);
  test.bench().tool.set(Tool::drag);
  for (const char* name : {"cpr1", "cpr2"}) {
    const QPoint wall = wall_on(test.picture(name), 20.0);
    sweep(test.picture(name), {wall, wall + QPoint(3, 0), wall + QPoint(6, 0)});
  }
  test.bench().tool.set(Tool::draw);
  view::PictureView& section = test.picture("section").view();
  std::vector<QPoint> around;
  for (int i = 0; i <= 48; ++i) {
    const double a = 2.0 * M_PI * i / 48.0;
    const Vec2 middle(section.width() / 2.0, section.height() / 2.0);
    around.push_back(point(middle + 1.1 / section.pixel_mm() * Vec2(std::cos(a), std::sin(a))));
  }
  sweep(test.picture("section"), around);
  EXPECT_EQ(test.bench().session().file().edits().size(), 3U);
  EXPECT_NEAR(test.bench().section(4, 20.0)->diameter_mm, 2.2, 0.1);
  QAction* undo = test.window().findChild<QAction*>("edit.undo");
  for (int i = 0; i < 3; ++i) undo->trigger();
  EXPECT_FALSE(undo->isEnabled());
  EXPECT_EQ(lumen::digest(*test.bench().model()), before);
  test.window().findChild<QAction*>("edit.redo")->trigger();
  EXPECT_EQ(test.bench().session().file().edits().size(), 1U);
}

TEST_F(WindowTest, EveryEditIsInTheFileAtOnceAndTheProgramOpensWhereItWas) {
  know_the_image();
  {
    TestWindow test(state);
    test.open(case_file);
    test.bench().tool.set(Tool::drag);
    const QPoint wall = wall_on(test.picture("cpr1"), 10.0);
    sweep(test.picture("cpr1"), {wall, wall + QPoint(4, 0), wall + QPoint(8, 0)});
    test.bench().cursor_mm.set(31.0);
    test.window().close();
  }
  EXPECT_EQ(stored_edits(), 1U);
  TestWindow again(state);
  again.open(case_file);
  EXPECT_NEAR(again.bench().cursor_mm.get(), 31.0, 1e-6);
}

TEST_F(WindowTest, WhatTheCoreRefusesIsSaidAndTheCaseIsUnchanged) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  test.bench().tool.set(Tool::draw);
  view::PictureView& cpr = test.picture("cpr1").view();
  std::vector<QPoint> across;
  for (int i = 0; i <= 10; ++i) across.push_back(point(Vec2(cpr.width() * (0.3 + 0.04 * i), 200.0 + i)));
  sweep(test.picture("cpr1"), across);
  EXPECT_TRUE(test.bench().session().file().edits().empty());
  EXPECT_FALSE(test.window().statusBar()->currentMessage().isEmpty());
  EXPECT_TRUE(test.window().findChild<QAction*>("edit.undo") &&
              !test.window().findChild<QAction*>("edit.undo")->isEnabled());
}

TEST_F(WindowTest, MeasurementsAreListedAndGoWithTheirStep) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  test.bench().tool.set(Tool::distance);
  sweep(test.picture("slice"), {QPoint(60, 60), QPoint(100, 80), QPoint(140, 120)});
  auto* list = test.window().findChild<MeasurementList*>("measurements");
  EXPECT_TRUE(wait_until([&] { return list->topLevelItemCount() == 1; }, 2000));
  EXPECT_TRUE(list->topLevelItem(0)->text(1).endsWith(" mm"));
  test.window().findChild<QAction*>("edit.undo")->trigger();
  EXPECT_TRUE(wait_until([&] { return list->topLevelItemCount() == 0; }, 2000));
}

TEST_F(WindowTest, OneClickMakesTheReportWithAPinnedView) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  test.window().reporting().pin(test.picture("section"));
  test.window().findChild<QAction*>("file.report")->trigger();
  ASSERT_TRUE(wait_until([&] { return !test.window().jobs().any(); }, 60000));
  EXPECT_NE(message().find("tube-report"), std::string::npos);
  for (const char* name :
       {"report.pdf", "report.html", "report.json", "segments.csv", "images/pinned-1.png", "manifest.json"})
    EXPECT_GT(fs::file_size(folder / "tube-report" / name), 100U) << name;
  EXPECT_EQ(core::read_file(folder / "tube-report" / "report.pdf").substr(0, 5), "%PDF-");
}

TEST_F(WindowTest, TheStepsGoBackAndForth) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  test.bench().tool.set(Tool::drag);
  for (const double s : {8.0, 20.0, 32.0}) {
    test.bench().cursor_mm.set(s);
    const QPoint wall = wall_on(test.picture("cpr1"), s);
    sweep(test.picture("cpr1"), {wall, wall + QPoint(4, 0), wall + QPoint(8, 0)});
  }
  auto* steps = test.window().findChild<StepList*>("steps");
  ASSERT_TRUE(wait_until([&] { return steps->count() == 4; }, 2000));
  emit steps->itemClicked(steps->item(1));
  EXPECT_EQ(test.bench().session().file().edits().size(), 1U);
  ASSERT_TRUE(wait_until([&] { return steps->count() == 4 && steps->currentRow() == 1; }, 2000));
  emit steps->itemClicked(steps->item(3));
  EXPECT_EQ(test.bench().session().file().edits().size(), 3U);
}

TEST_F(WindowTest, ChoosingAToolMakesNoImageAnew) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  const auto quiet = [] { testing::let_rest(); };
  quiet();
  view::PictureView& cpr = test.picture("cpr1").view();
  const QSize size = test.picture("cpr1").size();
  const std::uint64_t before = cpr.image_revision();
  for (const char* id : {"tool.drag", "tool.draw", "tool.browse"}) {
    test.window().findChild<QAction*>(id)->trigger();
    quiet();
    EXPECT_EQ(test.picture("cpr1").size(), size) << id;
    EXPECT_EQ(cpr.image_revision(), before) << id;
  }
}

TEST_F(WindowTest, AMaximisedPanelComesBack) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  const QWidget& content = *test.window().centralWidget();
  const QList<Panel*> panels = test.window().findChildren<Panel*>();
  ASSERT_EQ(panels.size(), 9);
  const auto place_of = [&](const QWidget& widget) {
    const QPoint at = widget.mapTo(&content, QPoint(0, 0));
    return QStringLiteral("%1 %2, %3 x %4")
        .arg(at.x())
        .arg(at.y())
        .arg(widget.width())
        .arg(widget.height())
        .toStdString();
  };
  const auto places = [&] {
    std::map<std::string, std::string> all;
    for (const QWidget* widget : content.findChildren<QWidget*>())
      if (widget->isVisible() && (!widget->objectName().isEmpty() || qobject_cast<const Panel*>(widget)))
        all[(widget->objectName() + " " + widget->accessibleName()).toStdString()] = place_of(*widget);
    return all;
  };
  ASSERT_TRUE(wait_until([&] { return test.window().lesions().idle(); }));
  testing::let_work(400);  // the list says no more that plaque is being looked for
  const std::map<std::string, std::string> before = places();
  ASSERT_GT(before.size(), 15U);
  for (Panel* panel : panels) {
    const std::string name = panel->accessibleName().toStdString();
    const auto double_click = [&] {
      QTest::mouseDClick(panel->findChild<QWidget*>(QString(), Qt::FindDirectChildrenOnly), Qt::LeftButton);
      testing::let_work(100);
    };
    double_click();
    EXPECT_EQ(place_of(*panel), place_of(content)) << name;
    for (const QWidget* other : content.findChildren<QWidget*>()) {
      const bool own = other == panel || panel->isAncestorOf(other) || other->isAncestorOf(panel);
      EXPECT_TRUE(own || !other->isVisible() || qobject_cast<const QSplitterHandle*>(other))
          << name << ", beside it " << other->objectName().toStdString();
    }
    double_click();
    EXPECT_EQ(places(), before) << name;
  }
}

TEST_F(WindowTest, TheFirstVesselIsMadeByTwoClicks) {
  TestWindow test(state);
  test.window().open(image);
  ASSERT_TRUE(wait_until([&] { return test.bench().image().volume && !test.window().jobs().any(); }));
  test.bench().tool.set(Tool::add_vessel);
  PictureWidget& slice = test.picture("slice");
  for (const double z : {3.0, 36.0}) {
    test.bench().place.set({0.0, 0.0, z});
    sweep(slice, {point(slice.view().project({0.0, 0.0, z})->px)});
  }
  ASSERT_TRUE(wait_until([&] { return test.bench().has_case(); }));
  EXPECT_NEAR(test.bench().axis()->length(), 33.0, 2.0);
  EXPECT_NEAR(test.bench().section(test.bench().vessel.get(), 15.0)->diameter_mm, 2.0 * window_radius_mm,
              0.3);
}

TEST_F(WindowTest, ASecondWindowOnTheCaseIsToldSo) {
  know_the_image();
  TestWindow one(state);
  one.open(case_file);
  TestWindow two(folder / "other-state");
  two.window().open(case_file);
  EXPECT_NE(two.failure().find("open"), std::string::npos);
  EXPECT_FALSE(two.bench().has_case());
  EXPECT_TRUE(one.bench().has_case());
}

TEST_F(WindowTest, AMissingImageIsAskedForAndTheCaseCanBeLookedAtWithout) {
  TestWindow test(state);
  test.window().open(case_file);
  EXPECT_NE(message().find("image"), std::string::npos);
  EXPECT_TRUE(test.bench().has_case());
  EXPECT_TRUE(test.picture("cpr1").view().ready());
}

TEST_F(WindowTest, WhatIsNoCaseIsRefusedInOneDialogAndTheOpenCaseStays) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  const fs::path fake = folder / "fake.ostia";
  std::ofstream(fake) << "not a case";
  test.window().open(fake);
  EXPECT_NE(message().find("fake.ostia"), std::string::npos);
  EXPECT_TRUE(test.bench().has_case());
  test.window().open(folder / "nothing-there.ostia");
  EXPECT_NE(message().find("nothing-there"), std::string::npos);
}

TEST_F(WindowTest, AnotherPatientsImageMakesRoomForItself) {
  know_the_image();
  TestWindow test(state);
  test.open(case_file);
  imaging::ImageVolume other = tube_image();
  other.voxels[5] = 17;
  imaging::write_image(folder / "other.nrrd", other);
  test.window().open(folder / "other.nrrd");
  ASSERT_TRUE(wait_until([&] { return !test.bench().has_case() && !test.window().jobs().any(); }));
  EXPECT_EQ((*test.bench().image().volume).voxels[5], 17);
}

TEST_F(WindowTest, APatientsNameIsShownAndNeverSaved) {
  const fs::path dicom = folder / "DOE_JANE";
  imaging::DicomSeriesOptions options;
  options.patient_name = "DOE^JANE";
  options.patient_id = "DOE-4711";
  imaging::write_dicom_series(dicom, tube_image(), options);
  {
    TestWindow test(state);
    test.window().open(dicom);
    ASSERT_TRUE(wait_until([&] {
      return test.bench().image().volume && test.bench().image().volume->geometry.size[2] == 110 &&
             !test.window().jobs().any();
    }));
    bool shown = false;
    for (const QLabel* label : test.window().findChildren<QLabel*>())
      shown = shown || label->text().contains("doe", Qt::CaseInsensitive);
    EXPECT_TRUE(shown);
    test.bench().tool.set(Tool::add_vessel);
    PictureWidget& slice = test.picture("slice");
    for (const double z : {3.0, 36.0}) {
      test.bench().place.set({0.0, 0.0, z});
      sweep(slice, {point(slice.view().project({0.0, 0.0, z})->px)});
    }
    ASSERT_TRUE(wait_until([&] { return test.bench().has_case(); }));
    test.window().close();
  }
  for (const auto& entry : fs::recursive_directory_iterator(state)) {
    const fs::path name = entry.path().filename();
    if (!entry.is_regular_file()) continue;
    if (name == "machine.json" || name == "patients.json") {  // the path, the name: on this machine alone
      EXPECT_EQ(entry.status().permissions() & (fs::perms::group_all | fs::perms::others_all),
                fs::perms::none)
          << name;
      continue;
    }
    const std::string bytes = core::read_file(entry.path());
    for (const char* secret : {"DOE^JANE", "DOE-4711", "DOE_JANE", "2.25."})
      EXPECT_EQ(bytes.find(secret), std::string::npos) << entry.path() << " " << secret;
  }
}

}  // namespace
}  // namespace ostia::workstation
