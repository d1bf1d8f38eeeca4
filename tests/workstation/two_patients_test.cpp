// One window, one patient after the other: nothing of the one stays for the other, and what was begun on one
// table does not end on another.

#include "measuring/reporting.h"
#include "opening/series_browser.h"
#include "tube_case.h"
#include "vessels/finder.h"
#include "window_hand.h"

#include "ostia/imaging/dicom.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QLineEdit>
#include <QMessageBox>
#include <QPushButton>
#include <QSignalSpy>
#include <QTimer>
#include <QTreeWidget>
#include <cmath>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using session::Tool;
using testing::sweep;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;

struct TwoPatients : ::testing::Test {
  testing::Folder folder;
  fs::path state = folder / "state";
  fs::path image = folder / "a.nrrd", case_file = folder / "a.ostia";
  fs::path other_image = folder / "b.nrrd", other_case = folder / "b.ostia";
  TwoPatients() {
    imaging::ImageVolume voxels = tube_image();
    imaging::write_image(image, voxels);
    voxels.voxels[5] = 17;
    imaging::write_image(other_image, voxels);
    session::MachineState machine(state);
    for (const auto& [file, of] : {std::pair(case_file, image), {other_case, other_image}}) {
      const session::ImageReference reference = session::image_reference(of);
      session::CaseFile::create(file, tube_model(), reference);
      machine.remember_image(reference.sha256, of);
    }
  }
  static bool idle(TestWindow& test) {
    return wait_until([&] { return !test.window().jobs().any(); }, 60000);
  }
  static void open(TestWindow& test, const fs::path& what) {
    test.window().open(what);
    ASSERT_TRUE(idle(test));
  }
  static void rest(int ms) { testing::let_work(ms); }
  static std::string shown_name(TestWindow& test) {
    return test.window().findChild<QLabel*>("shown_name")->text().toStdString();
  }
  static void click(TestWindow& test, double z) {
    test.bench().tool.set(Tool::add_vessel);
    test.bench().place.set({0.0, 0.0, z});
    PictureWidget& slice = test.picture("slice");
    const view::Vec2 px = slice.view().project({0.0, 0.0, z})->px;
    sweep(slice, {QPoint(static_cast<int>(std::lround(px.x())), static_cast<int>(std::lround(px.y())))});
  }
  static QMessageBox* box_on_screen() {
    QMessageBox* box = nullptr;
    wait_until([&] {
      for (QWidget* widget : QApplication::topLevelWidgets())
        if (auto* one = qobject_cast<QMessageBox*>(widget); one && one->isVisible()) box = one;
      return box != nullptr;
    });
    return box;
  }
  /// Two series in one folder, the first brighter by `step`, and the path of the folder.
  fs::path two_series(int step) {
    const fs::path dicom = folder / "JANE^DOE";
    fs::create_directories(dicom);
    for (int i = 0; i < 2; ++i) {
      imaging::ImageVolume voxels = tube_image();
      for (std::int16_t& value : voxels.voxels) value = static_cast<std::int16_t>(value + (1 - i) * step);
      imaging::DicomSeriesOptions options;
      options.patient_name = "DOE^JANE";
      options.uid_seed = "series " + std::to_string(i);
      options.series_description = "phase " + std::to_string(i);
      imaging::write_dicom_series(dicom / std::to_string(i), voxels, options);
    }
    return dicom;
  }
};

TEST_F(TwoPatients, WhatIsPinnedGoesWithItsCase) {
  TestWindow test(state);
  open(test, case_file);
  test.window().reporting().pin(test.picture("section"));
  EXPECT_EQ(test.window().reporting().pinned(), 1U);
  open(test, other_case);
  EXPECT_EQ(test.window().reporting().pinned(), 0U);
  test.window().reporting().make_report(other_case);
  ASSERT_TRUE(idle(test));
  EXPECT_TRUE(fs::exists(folder / "b-report" / "report.pdf"));
  EXPECT_FALSE(fs::exists(folder / "b-report" / "images" / "pinned-1.png"));
}

TEST_F(TwoPatients, WhatIsPinnedWhileAReportIsMadeWaitsForTheNext) {
  TestWindow test(state);
  open(test, case_file);
  Reporting& reporting = test.window().reporting();
  reporting.pin(test.picture("section"));
  reporting.make_report(case_file);
  reporting.pin(test.picture("cpr1"));
  ASSERT_TRUE(idle(test));
  EXPECT_EQ(reporting.pinned(), 1U);
  EXPECT_FALSE(fs::exists(folder / "a-report" / "images" / "pinned-2.png"));
  reporting.make_report(case_file);
  reporting.pin(test.picture("cpr1"));
  open(test, other_case);  // the report of the first case ends on the second one's table
  ASSERT_TRUE(idle(test));
  EXPECT_TRUE(fs::exists(folder / "a-report-2" / "images" / "pinned-1.png"));
  EXPECT_EQ(reporting.pinned(), 0U);
}

TEST_F(TwoPatients, AVesselThatIsSoughtOnOneCaseIsNotPutIntoAnother) {
  TestWindow test(state);
  lumen::LumenModel half = lumen::apply(tube_model(), lumen::AxisTrim{4, 20.0}).model;
  const fs::path short_case = folder / "short.ostia";
  session::CaseFile::create(short_case, half, session::image_reference(image));
  open(test, short_case);
  test.window().finder().find_vessel({0.0, 0.0, 38.0});
  ASSERT_TRUE(test.window().jobs().running("path"));
  const fs::path twin = folder / "twin.ostia";
  session::CaseFile::create(twin, half, session::image_reference(image));
  test.bench().set_session(session::Session(session::CaseFile::open(twin)));
  ASSERT_TRUE(idle(test));
  rest(300);
  EXPECT_TRUE(test.bench().session().file().edits().empty());
  EXPECT_TRUE(session::CaseFile::open(short_case, session::OpenMode::read_only).edits().empty());
}

TEST_F(TwoPatients, TheFirstOfTwoClicksIsForgottenWithItsImage) {
  TestWindow test(state);
  open(test, image);
  click(test, 3.0);
  open(test, other_image);
  click(test, 36.0);  // the first click on this one
  EXPECT_FALSE(test.window().jobs().running("path"));
  rest(300);
  EXPECT_FALSE(test.bench().has_case());
}

TEST_F(TwoPatients, TheFirstOfTwoClicksIsForgottenWithItsTool) {
  TestWindow test(state);
  open(test, image);
  click(test, 3.0);
  test.bench().tool.set(Tool::browse);
  click(test, 36.0);
  EXPECT_FALSE(test.window().jobs().running("path"));
}

TEST_F(TwoPatients, AVesselThroughFatIsRefused) {
  TestWindow test(state);
  open(test, image);
  test.window().finder().find_vessel({8.0, 8.0, 3.0});
  test.window().finder().find_vessel({8.0, 8.0, 36.0});
  ASSERT_TRUE(idle(test));
  EXPECT_FALSE(test.bench().has_case());
  QMessageBox* box = box_on_screen();
  ASSERT_TRUE(box);
  box->close();
}

TEST_F(TwoPatients, SavedAsAnotherTheNextEditIsInTheOther) {
  TestWindow test(state);
  open(test, case_file);
  const fs::path copy = folder / "copy.ostia";
  QTimer::singleShot(0, [&] {
    auto* dialog = QApplication::activeModalWidget();
    ASSERT_TRUE(dialog);
    auto* name = dialog->findChild<QLineEdit*>("fileNameEdit");
    ASSERT_TRUE(name);
    name->setText(QString::fromStdString(copy.string()));
    QMetaObject::invokeMethod(dialog, "accept");
  });
  test.window().findChild<QAction*>("file.save_as")->trigger();
  EXPECT_FALSE(test.window().isEnabled());
  ASSERT_TRUE(idle(test));
  EXPECT_TRUE(test.window().isEnabled());
  test.bench().edit(lumen::VesselRename{4, "RCA"});
  test.window().close();
  EXPECT_EQ(session::CaseFile::open(copy, session::OpenMode::read_only).edits().size(), 1U);
  EXPECT_TRUE(session::CaseFile::open(case_file, session::OpenMode::read_only).edits().empty());
}

TEST_F(TwoPatients, AWayThatComesToAVesselsEndLengthensIt) {
  TestWindow test(state);
  const fs::path short_case = folder / "short.ostia";
  session::CaseFile::create(short_case, lumen::apply(tube_model(), lumen::AxisTrim{4, 20.0}).model,
                            session::image_reference(image));
  open(test, short_case);
  EXPECT_NEAR(test.bench().axis()->length(), 20.0, 0.6);
  click(test, 36.0);
  ASSERT_TRUE(idle(test));
  EXPECT_EQ(test.bench().model()->tree.vessels.size(), 1U);
  EXPECT_NEAR(test.bench().axis()->length(), 36.0, 1.0);
  EXPECT_NEAR(test.bench().section(4, 30.0)->diameter_mm, 2.0 * testing::tube_radius_mm, 0.4);
  test.window().findChild<QAction*>("edit.undo")->trigger();
  EXPECT_NEAR(test.bench().axis()->length(), 20.0, 0.6);
}

TEST_F(TwoPatients, TheNameIsThatOfTheImageOnTheTable) {
  const fs::path dicom = folder / "dicom";
  imaging::DicomSeriesOptions options;
  options.patient_name = "ROE^RICHARD";
  imaging::write_dicom_series(dicom, tube_image(), options);
  TestWindow test(state);
  open(test, case_file);
  EXPECT_EQ(shown_name(test), "a.nrrd");
  // Begun and given up: the name of the one must not stand over the pictures of the other.
  test.window().open(dicom);
  ASSERT_TRUE(wait_until([&] { return test.window().jobs().running("first slice"); }));
  ASSERT_TRUE(wait_until([&] { return !test.window().jobs().running("first slice"); }));
  if (test.window().jobs().running("open")) {
    EXPECT_EQ(shown_name(test), "a.nrrd");
  }
  test.window().jobs().cancel("open");
  ASSERT_TRUE(idle(test));
  const bool came = test.bench().image().volume->geometry.size[2] == 110 && !test.bench().has_case();
  EXPECT_EQ(shown_name(test).find("ROE") != std::string::npos, came) << shown_name(test);
  open(test, dicom);
  EXPECT_NE(shown_name(test).find("ROE"), std::string::npos);
  // A case whose image is not to be found has none.
  fs::remove(other_image);
  open(test, other_case);
  ASSERT_TRUE(test.bench().has_case());
  EXPECT_FALSE(test.bench().image().volume);
  EXPECT_EQ(shown_name(test), "");
  box_on_screen()->close();
}

TEST_F(TwoPatients, AReadingThatIsGivenUpLeavesNoSliceBehind) {
  const fs::path dicom = folder / "dicom";
  imaging::ImageVolume large = tube_image();  // so that the first slice is there long before the last
  large.geometry.size = {384, 384, 200};
  large.voxels.assign(static_cast<std::size_t>(large.geometry.voxels()), 100);
  imaging::write_dicom_series(dicom, large);
  // The first slice and the whole are read side by side: on a busy machine the whole may be there first.
  constexpr int tries = 10;
  for (int i = 0; i < tries; ++i) {
    TestWindow test(state);
    bool slice_shown = false;
    const auto watch = test.bench().image_changed.observe([&] {
      const session::OpenImage& shown = test.bench().image();
      if (!shown.volume || !shown.reference.sha256.empty()) return;
      slice_shown = true;
      click(test, 3.0);  // on an image of which the rest is not there yet
      click(test, 5.0);
      test.window().jobs().cancel("open");
    });
    test.window().open(dicom);
    ASSERT_TRUE(wait_until([&] { return slice_shown || test.bench().image().volume; }));
    ASSERT_TRUE(idle(test));
    if (!slice_shown) continue;
    EXPECT_FALSE(test.bench().image().volume);
    EXPECT_EQ(shown_name(test), "");
    EXPECT_FALSE(test.bench().has_case());
    return;
  }
  FAIL() << "no first slice before the whole in " << tries << " readings";
}

TEST_F(TwoPatients, TheHeartBehindTheTreeIsThatOfTheImageOnTheTable) {
  TestWindow test(state);
  open(test, case_file);
  test.window().scene().set_volume_mode(view::VolumeMode::rendering);
  ASSERT_TRUE(idle(test));
  QSignalSpy wanted(&test.window().scene(), &SceneWidget::volume_wanted);
  open(test, other_case);
  EXPECT_GE(wanted.count(), 1);
  ASSERT_TRUE(idle(test));
  test.window().scene().set_volume_mode(view::VolumeMode::off);
  wanted.clear();
  open(test, case_file);
  EXPECT_EQ(wanted.count(), 0);
}

TEST_F(TwoPatients, AnotherSeriesOfTheFolderIsAnotherImage) {
  const fs::path dicom = two_series(30);
  const imaging::DicomFolder found = imaging::scan_dicom(dicom);
  ASSERT_EQ(found.series.size(), 2U);
  TestWindow test(state);
  const auto choose = [&](int row) {
    test.window().open(dicom);
    ASSERT_TRUE(wait_until([&] { return test.window().findChild<SeriesBrowser*>("series") != nullptr; }));
    auto* browser = test.window().findChild<SeriesBrowser*>("series");
    auto* list = browser->findChild<QTreeWidget*>();
    list->setCurrentItem(list->topLevelItem(row));
    emit list->itemDoubleClicked(list->currentItem(), 0);
    ASSERT_TRUE(wait_until([&] { return !test.bench().image().reference.sha256.empty(); }));
    ASSERT_TRUE(idle(test));
    rest(50);  // the browser goes
  };
  choose(0);
  const session::OpenImage first = test.bench().image();
  choose(1);
  const session::OpenImage second = test.bench().image();
  EXPECT_NE(first.reference.sha256, second.reference.sha256);
  EXPECT_NE(first.volume->voxels, second.volume->voxels);
  // A case of the second opens with the second, without asking.
  const fs::path of_second = folder / "second.ostia";
  session::CaseFile::create(of_second, tube_model(), second.reference);
  TestWindow later(state);
  open(later, of_second);
  EXPECT_FALSE(later.window().findChild<SeriesBrowser*>("series"));
  ASSERT_TRUE(later.bench().image().volume);
  EXPECT_EQ(later.bench().image().volume->voxels, second.volume->voxels);
}

TEST_F(TwoPatients, AWrongImageForACaseIsSaidAndAskedForAgain) {
  fs::rename(image, folder / "moved.nrrd");
  TestWindow test(state);
  open(test, case_file);
  QMessageBox* box = box_on_screen();
  ASSERT_TRUE(box);
  box->close();
  rest(50);
  open(test, other_image);
  ASSERT_TRUE(test.bench().has_case());
  EXPECT_FALSE(test.bench().image().volume);
  box = box_on_screen();
  ASSERT_TRUE(box);
  EXPECT_NE(box->text().toStdString().find("another image"), std::string::npos);
  EXPECT_GE(box->buttons().size(), 3);
  box->close();
  rest(50);
  open(test, folder / "moved.nrrd");
  EXPECT_TRUE(test.bench().has_case());
  EXPECT_TRUE(test.bench().image().volume);
  EXPECT_EQ(shown_name(test), "moved.nrrd");
}

TEST_F(TwoPatients, WhereThePersonLooksIsKeptWithoutClosing) {
  {
    TestWindow test(state);
    open(test, case_file);
    test.bench().cursor_mm.set(31.0);
    test.bench().theta_deg.set(42.0);
    test.bench().curved_mode.set(reformat::CurvedMode::stretched);
    test.bench().grey.set({111.0, 777.0});
    rest(2500);
    EXPECT_EQ(test.bench().session().file().setting("view.cursor_mm"), "31");
  }  // the window goes without being closed, as in a crash
  TestWindow again(state);
  ASSERT_TRUE(wait_until([&] { return again.bench().has_case() && !again.window().jobs().any(); }));
  EXPECT_NEAR(again.bench().cursor_mm.get(), 31.0, 1e-6);
  EXPECT_NEAR(again.bench().theta_deg.get(), 42.0, 1e-6);
  EXPECT_EQ(again.bench().curved_mode.get(), reformat::CurvedMode::stretched);
  EXPECT_EQ(again.bench().grey.get(), (session::GreyWindow{111.0, 777.0}));
}

TEST_F(TwoPatients, ASecondWindowLeavesTheFirstOnesCaseAlone) {
  auto first = std::make_unique<TestWindow>(state);
  open(*first, case_file);
  {
    TestWindow second(state);  // no case is named
    rest(500);
    EXPECT_FALSE(second.bench().has_case());
    for (QWidget* widget : QApplication::topLevelWidgets())
      EXPECT_FALSE(qobject_cast<QMessageBox*>(widget) && widget->isVisible());
    open(second, other_case);
    second.window().close();
  }
  first.reset();  // as in a crash
  TestWindow third(state);
  ASSERT_TRUE(wait_until([&] { return third.bench().has_case() && !third.window().jobs().any(); }));
  EXPECT_EQ(third.bench().session().file().image()->sha256, session::image_reference(image).sha256);
}

TEST_F(TwoPatients, ClosingAsksWhileAReportIsBeingMade) {
  TestWindow test(state);
  open(test, case_file);
  test.window().reporting().make_report(case_file);
  const auto answer = [&](QMessageBox::ButtonRole role) {
    QTimer::singleShot(0, [role] {
      auto* box = qobject_cast<QMessageBox*>(QApplication::activeModalWidget());
      ASSERT_TRUE(box);
      for (QAbstractButton* button : box->buttons())
        if (box->buttonRole(button) == role) button->click();
    });
    return test.window().close();
  };
  EXPECT_FALSE(answer(QMessageBox::RejectRole));
  EXPECT_TRUE(test.window().isVisible());
  EXPECT_TRUE(test.bench().has_case());
  EXPECT_TRUE(answer(QMessageBox::DestructiveRole));
  EXPECT_FALSE(test.window().isVisible());
}

}  // namespace
}  // namespace ostia::workstation
