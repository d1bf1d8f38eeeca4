// A study of several phases in one window, by mouse and keys: the strip, its slider and cine, the sharpest
// phase, and what must not be mixed.

#include "phases/series_strip.h"

#include "known_motion.h"
#include "layout_faults.h"
#include "opening/series_browser.h"
#include "phases/bar.h"
#include "phases/beating_case.h"
#include "phases/study_series.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"
#include "ostia/io/cage_motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <QAction>
#include <QLabel>
#include <QPushButton>
#include <QSlider>
#include <QStatusBar>
#include <QTest>
#include <QToolButton>
#include <QTreeWidget>
#include <algorithm>
#include <cstdlib>
#include <set>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::TestWindow;
using testing::wait_until;

constexpr int rest_percent = 55;

/// The tube along z, smeared along x by a way that grows from its rest; brighter by its percent, so that it
/// is seen which one is shown.
imaging::ImageVolume smeared_tube(int percent) {
  imaging::ImageVolume image;
  image.geometry.size = {64, 64, 60};
  image.geometry.spacing = {0.4, 0.4, 0.7};
  image.geometry.origin = {-12.6, -12.6, -1.0};
  image.voxels.resize(static_cast<std::size_t>(image.geometry.voxels()));
  const double smear = 0.08 * std::abs(percent - rest_percent);
  // Every slice is the first: nothing changes along the tube.
  constexpr std::int64_t side = 64;
  for (std::int64_t j = 0; j < side; ++j)
    for (std::int64_t i = 0; i < side; ++i) {
      const geometry::Vec3 at = image.geometry.world({static_cast<double>(i), static_cast<double>(j), 0.0});
      double inside = 0.0;
      for (int n = -3; n <= 3; ++n)
        inside +=
            std::clamp(0.5 - (std::hypot(at.x() - smear * n / 6.0, at.y()) - 1.5) / 0.7, 0.0, 1.0) / 7.0;
      image(i, j, 0) = static_cast<std::int16_t>(std::lround(-80.0 + 480.0 * inside));
    }
  for (std::ptrdiff_t k = 1; k < 60; ++k)
    std::copy_n(image.voxels.begin(), side * side, image.voxels.begin() + k * side * side);
  image(0, 0, 0) = static_cast<std::int16_t>(1000 + percent);
  return image;
}

void write_series(const fs::path& study, int percent, const std::string& name, const std::string& id,
                  const std::string& study_seed, const imaging::ImageVolume& image) {
  imaging::DicomSeriesOptions options;
  options.patient_name = name;
  options.patient_id = id;
  options.study_seed = study_seed;
  options.uid_seed = id + std::to_string(percent);
  options.series_description = "CTA " + std::to_string(percent) + " % B26f";
  imaging::write_dicom_series(study / (id + "-" + std::to_string(percent)), image, options);
}
void write_series(const fs::path& study, int percent, const std::string& name, const std::string& id,
                  const std::string& study_seed) {
  write_series(study, percent, name, id, study_seed, smeared_tube(percent));
}

/// A study of five phases, written once.
fs::path five_phases() {
  static const testing::Folder folder;
  static const fs::path study = [] {
    for (const int percent : {15, 35, 55, 75, 95})
      write_series(folder / "study", percent, "DOE^JANE", "P1", "study");
    return folder / "study";
  }();
  return study;
}

struct StudyWindow : ::testing::Test {
  testing::Folder folder;
  fs::path study = folder / "study";
  std::unique_ptr<TestWindow> test;

  StudyWindow() { fs::copy(five_phases(), study, fs::copy_options::recursive); }
  ~StudyWindow() override { QApplication::processEvents(); }
  void add(int percent, const std::string& name, const std::string& id, const std::string& study_seed) {
    write_series(study, percent, name, id, study_seed);
  }
  MainWindow& window() { return test->window(); }
  session::Workbench& bench() { return test->bench(); }
  StudySeries& series() { return window().series(); }
  bool idle() {
    return wait_until([&] { return !window().jobs().any(); }, 120000) &&
           wait_until([&] { return !window().jobs().any(); });
  }
  template <class Part>
  Part* part(const char* name) {
    auto* found = window().findChild<Part*>(name);
    if (!found) throw std::runtime_error(std::string("there is no ") + name);
    return found;
  }
  QListWidget& list() { return *part<QListWidget>("series_list"); }
  /// By the browser: a double click on the series with this text.
  void open_study(const QString& text = "75 %") {
    test = std::make_unique<TestWindow>(folder / "state");
    window().open(study);
    ASSERT_TRUE(wait_until([&] { return window().findChild<SeriesBrowser*>() != nullptr; }));
    auto* tree = window().findChild<SeriesBrowser*>()->findChild<QTreeWidget*>();
    QTreeWidgetItem* item = nullptr;
    for (int n = 0; n < tree->topLevelItemCount(); ++n)
      if (tree->topLevelItem(n)->text(1).contains(text)) item = tree->topLevelItem(n);
    ASSERT_TRUE(item);
    tree->setCurrentItem(item);
    for (QPushButton* button : window().findChild<SeriesBrowser*>()->findChildren<QPushButton*>())
      if (button->isDefault()) QTest::mouseClick(button, Qt::LeftButton);
    ASSERT_TRUE(wait_until([&] { return !bench().image().reference.sha256.empty(); }, 60000));
    ASSERT_TRUE(idle());
    ASSERT_TRUE(wait_until([&] { return !series().has_cine() || series().choice().has_value(); }, 60000));
    ASSERT_TRUE(idle());
    testing::let_rest();
  }
  /// A case of the image on the table, opened as a person opens it.
  void open_case() {
    const fs::path file = folder / "tube.ostia";
    session::CaseFile::create(file, testing::tube_model(), bench().image().reference);
    test->open(file);
    ASSERT_TRUE(idle());
    testing::let_rest();
  }
  int row_of(const QString& title) {
    for (int n = 0; n < list().count(); ++n)
      if (list().item(n)->text().startsWith(title)) return n;
    return -1;
  }
  QString note_of(const QString& title) {
    const int row = row_of(title);
    return row < 0 ? QString() : list().item(row)->text().section('\n', 1);
  }
  void click(const QString& title) {
    QListWidgetItem* item = list().item(row_of(title));
    ASSERT_TRUE(item) << title.toStdString();
    list().scrollToItem(item);
    QTest::mouseClick(list().viewport(), Qt::LeftButton, {}, list().visualItemRect(item).center());
  }
  /// Which percent the views show, by the image's own voxel.
  int shown_percent() { return (*bench().shown_volume())(0, 0, 0) - 1000; }
  bool comes(int percent) {
    return wait_until([&] { return shown_percent() == percent && !window().jobs().any(); }, 60000);
  }
  QString caption(const char* view = "slice") {
    for (const view::OverlayText& text : test->picture(view).view().overlay().texts)
      if (text.text.starts_with("image ")) return QString::fromStdString(text.text);
    return {};
  }
};

TEST_F(StudyWindow, AFoldersPhasesAreInTheStripAndTheSharpestIsProposed) {
  open_study();
  EXPECT_TRUE(series().strip().isVisible());
  ASSERT_EQ(list().count(), 5);
  EXPECT_EQ(row_of("15 %"), 0);
  EXPECT_EQ(row_of("95 %"), 4);
  EXPECT_EQ(list().currentRow(), row_of("75 %"));
  EXPECT_EQ(shown_percent(), 75);
  for (int n = 0; n < 5; ++n) {
    const QImage picture = list().item(n)->icon().pixmap(72, 72).toImage();
    EXPECT_GT(qGray(picture.pixel(picture.width() / 2, picture.height() / 2)), 60) << n << ": no picture";
  }
  auto* best = part<QPushButton>("series_best");
  EXPECT_EQ(best->text(), "Sharpest: 55 %");
  EXPECT_EQ(note_of("55 %"), "sharpest");
  EXPECT_THAT(note_of("75 %").toStdString(), HasSubstr(" % sharp"));
  EXPECT_TRUE(testing::layout_faults(window()).isEmpty())
      << testing::layout_faults(window()).join("\n").toStdString();
  testing::on_screen(window(), "series_75");
  QTest::mouseClick(best, Qt::LeftButton);
  EXPECT_TRUE(comes(rest_percent));
  EXPECT_EQ(caption(), "image 55 %");
  testing::on_screen(window(), "series_55");
}

TEST_F(StudyWindow, ClicksKeysAndTheSliderChooseAndThereIsAWayBack) {
  open_study();
  click("35 %");
  ASSERT_TRUE(comes(35));
  EXPECT_EQ(caption(), "image 35 %");
  EXPECT_TRUE(part<QPushButton>("series_back")->isEnabled());
  QTest::keyClick(&list(), Qt::Key_Right);
  ASSERT_TRUE(comes(55));
  QTest::keyClick(&list(), Qt::Key_Left);
  ASSERT_TRUE(comes(35)) << "it is held";
  auto* slider = part<QSlider>("series_slider");
  EXPECT_EQ(slider->value(), 1);
  slider->setFocus();
  QTest::keyClick(slider, Qt::Key_End);
  ASSERT_TRUE(comes(95));
  EXPECT_EQ(list().currentRow(), 4);
  QTest::mouseClick(part<QPushButton>("series_back"), Qt::LeftButton);
  EXPECT_EQ(shown_percent(), 75);
  EXPECT_EQ(list().currentRow(), row_of("75 %"));
  EXPECT_EQ(caption(), "");
  EXPECT_FALSE(part<QPushButton>("series_back")->isEnabled());
}

TEST_F(StudyWindow, TheCineGoesThroughAllPhasesAndPauses) {
  open_study();
  std::vector<int> frames;
  const auto kept = bench().other_image_changed.observe([&] { frames.push_back(shown_percent()); });
  auto* play = part<QToolButton>("series_play");
  QTest::mouseClick(play, Qt::LeftButton);
  ASSERT_TRUE(series().playing());
  const auto seen = [&] { return std::set<int>(frames.begin(), frames.end()); };
  ASSERT_TRUE(wait_until([&] { return seen().size() == 5; }, 60000));
  ASSERT_TRUE(wait_until([&] { return !window().jobs().any(); }, 60000));
  frames.clear();
  ASSERT_TRUE(wait_until([&] { return frames.size() >= 6; }, 60000));
  for (std::size_t n = 1; n < 6; ++n)
    EXPECT_EQ(frames[n], frames[n - 1] == 95 ? 15 : frames[n - 1] + 20) << "one after the other";
  QTest::mouseClick(play, Qt::LeftButton);
  EXPECT_FALSE(series().playing());
  testing::let_work(300);
  const std::size_t count = frames.size();
  testing::let_work(400);
  EXPECT_EQ(frames.size(), count) << "it stands";
  part<QAction>("view.series_play")->trigger();
  EXPECT_TRUE(series().playing());
  click("15 %");
  EXPECT_FALSE(series().playing()) << "the hand has it";
  EXPECT_TRUE(comes(15));
}

TEST_F(StudyWindow, WhatDoesNotFitPlaysMoreCoarselyWithinTheBound) {
  open_study();
  const std::size_t one = bench().image().volume->voxels.size() * 2;
  series().set_budget(2 * one);
  QTest::mouseClick(part<QToolButton>("series_play"), Qt::LeftButton);
  EXPECT_THAT(window().statusBar()->currentMessage().toStdString(), HasSubstr("more coarsely"));
  std::set<std::size_t> sizes;
  std::set<const imaging::ImageVolume*> seen;
  const auto kept = bench().other_image_changed.observe([&] {
    sizes.insert(bench().shown_volume()->voxels.size() * 2);
    seen.insert(bench().shown_volume());
  });
  ASSERT_TRUE(wait_until([&] { return seen.size() >= 5; }, 60000));
  EXPECT_LT(*sizes.begin(), one / 4) << "a phase is coarse";
  QTest::mouseClick(part<QToolButton>("series_play"), Qt::LeftButton);
  click("35 %");
  ASSERT_TRUE(comes(35));
  EXPECT_EQ(bench().shown_volume()->voxels.size() * 2, one) << "what is looked at is whole";
}

TEST_F(StudyWindow, WithACaseTheAxesStayAndItIsSaidAndNothingIsEdited) {
  open_study();
  open_case();
  ASSERT_TRUE(series().strip().isVisible());
  click("35 %");
  ASSERT_TRUE(comes(35));
  for (const char* view : {"slice", "section", "cpr1", "cpr2"})
    EXPECT_EQ(caption(view), "image 35 %, axes of 75 %") << view;
  EXPECT_FALSE(test->picture("cpr1").view().contour_lines().empty()) << "the walls are the case's";
  testing::on_screen(window(), "series_case_35");
  lumen::WallDrag edit;
  edit.vessel = bench().vessel.get();
  edit.from = {1.5, 0.0, 20.0};
  edit.to = {2.5, 0.0, 20.0};
  EXPECT_THROW(bench().edit(edit), InvalidInput);
  auto* back = part<QPushButton>("series_back");
  EXPECT_EQ(window().focusWidget(), back) << "the way back is one key away";
  QTest::keyClick(back, Qt::Key_Space);
  EXPECT_EQ(shown_percent(), 75);
  EXPECT_NO_THROW(bench().edit(edit));
  part<QAction>("view.best_phase")->trigger();
  ASSERT_TRUE(idle());
  EXPECT_EQ(part<QPushButton>("series_best")->text(), "Sharpest: 55 %");
  EXPECT_THAT(part<QPushButton>("series_best")->toolTip().toStdString(), HasSubstr("without a motion"));
}

TEST_F(StudyWindow, AMotionCarriesTheAxesToThePhaseThatIsChosen) {
  open_study();
  open_case();
  const fs::path motion = folder / "motion.json";
  io::write_cage_motion(motion, {session::testing::known_motion({-9.0, -9.0, -4.0}, {9.0, 9.0, 44.0}), ""});
  testing::answer_file_dialog(motion);
  part<QAction>("file.motion")->trigger();
  ASSERT_TRUE(wait_until([&] { return window().beating().shown(); }));
  EXPECT_EQ(part<QToolButton>("phase_images")->text(), "Images: 5") << "the study's own";
  bench().cursor_mm.set(16.0);
  click("35 %");
  EXPECT_NEAR(window().beating().clock().percent.get(), 35.0, 1e-6);
  ASSERT_TRUE(bench().other_phase());
  ASSERT_TRUE(wait_until([&] { return shown_percent() == 35; }, 60000));
  EXPECT_EQ(caption(), "") << "image and tree are of one phase";
  EXPECT_NEAR(bench().place.get().x(), 4.0 * session::testing::contraction(0.35), 0.05);
  part<PhaseSlider>("phase")->setFocus();
  QTest::keyClick(part<PhaseSlider>("phase"), Qt::Key_Home);
  EXPECT_EQ(list().currentRow(), 4) << "the nearest of the phases: 95 %";
  QTest::mouseClick(part<QPushButton>("series_back"), Qt::LeftButton);
  EXPECT_FALSE(bench().other_phase());
  EXPECT_EQ(list().currentRow(), row_of("75 %"));
}

TEST_F(StudyWindow, ABadPhaseIsNamedAndLeftOut) {
  open_study();
  for (const fs::directory_entry& one : fs::directory_iterator(study / "P1-35")) {
    fs::resize_file(one.path(), 600);  // since it was looked at
  }
  click("35 %");
  ASSERT_TRUE(wait_until([&] { return note_of("35 %") == "cannot be read"; }, 60000));
  EXPECT_THAT(window().statusBar()->currentMessage().toStdString(), HasSubstr("35 % cannot be read"));
  EXPECT_EQ(shown_percent(), 75) << "what was shown stays";
  EXPECT_EQ(list().currentRow(), row_of("75 %"));
  EXPECT_EQ(part<QSlider>("series_slider")->maximum(), 3);
  click("55 %");
  EXPECT_TRUE(comes(55)) << "the others are there";
  part<QAction>("view.best_phase")->trigger();
  ASSERT_TRUE(idle());
  EXPECT_EQ(part<QPushButton>("series_best")->text(), "Sharpest: 55 %");
}

TEST_F(StudyWindow, ASeriesThatChangesItsSizeHalfwayIsTwoPictures) {
  const imaging::ImageVolume wide = smeared_tube(15);
  imaging::ImageVolume narrow;
  narrow.geometry = wide.geometry;
  narrow.geometry.size[0] = 48;
  for (std::int64_t k = 0; k < 60; ++k)
    for (std::int64_t j = 0; j < 64; ++j)
      for (std::int64_t i = 0; i < 48; ++i) narrow.voxels.push_back(wide(i, j, k));
  write_series(folder / "narrow", 15, "DOE^JANE", "P1", "study", narrow);
  for (int n = 31; n <= 60; ++n) {
    const fs::path file = fs::path("P1-15") / ("CT00" + std::to_string(n) + ".dcm");
    fs::copy_file(folder / "narrow" / file, study / file, fs::copy_options::overwrite_existing);
  }
  open_study();
  ASSERT_EQ(list().count(), 6);
  std::set<std::int64_t> widths;
  for (int row = 0; row < list().count(); ++row) {
    if (!list().item(row)->text().startsWith("15 %")) continue;
    const auto before = bench().shown_volume();
    list().setCurrentRow(row);
    ASSERT_TRUE(
        wait_until([&] { return bench().shown_volume() != before && !window().jobs().any(); }, 60000));
    EXPECT_EQ(bench().shown_volume()->geometry.size[2], 30) << "never one image of both";
    widths.insert(bench().shown_volume()->geometry.size[0]);
  }
  EXPECT_EQ(widths, (std::set<std::int64_t>{48, 64}));
  click("35 %");
  EXPECT_TRUE(comes(35)) << "the others are there";
}

TEST_F(StudyWindow, AnotherPatientsSeriesAreNeverInTheStrip) {
  add(45, "ROE^RICHARD", "P2", "other");
  add(65, "DOE^JANE", "P1", "another day");
  open_study();
  EXPECT_EQ(list().count(), 5);
  EXPECT_EQ(row_of("45 %"), -1);
  EXPECT_THAT(series().strip().windowTitle().toStdString(), HasSubstr("2 series of other patients"));
  // Another folder, by its command: the other patient's alone.
  const fs::path beside = folder / "beside";
  fs::create_directories(beside);
  fs::rename(study / "P2-45", beside / "P2-45");
  testing::answer_file_dialog(beside);
  part<QAction>("file.phases")->trigger();
  EXPECT_THAT(testing::message(), HasSubstr("never shown together"));
  EXPECT_EQ(list().count(), 5);
}

TEST_F(StudyWindow, WorkingOnAnotherPutsItOnTheTable) {
  open_study();
  click("55 %");
  ASSERT_TRUE(comes(55));
  const std::string before = bench().image().reference.sha256;
  QTest::mouseClick(part<QPushButton>("series_open"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return bench().image().reference.sha256 != before && !window().jobs().any(); },
                         120000));
  EXPECT_FALSE(bench().other_image());
  EXPECT_EQ(shown_percent(), 55);
  EXPECT_TRUE(series().strip().isVisible());
  EXPECT_THAT(note_of("55 %").toStdString(), HasSubstr("on the table"));
  EXPECT_EQ(list().currentRow(), row_of("55 %"));
}

TEST_F(StudyWindow, ASeriesOfASecondFolderIsPutOnTheTableAndTheStripStays) {
  const fs::path beside = folder / "beside";
  fs::create_directories(beside);
  fs::rename(study / "P1-35", beside / "P1-35");
  open_study();
  EXPECT_EQ(list().count(), 4);
  testing::answer_file_dialog(beside);
  part<QAction>("file.phases")->trigger();
  ASSERT_TRUE(wait_until([&] { return list().count() == 5; }, 60000));
  ASSERT_TRUE(idle());
  const auto work_on = [&](const QString& title, int percent) {
    click(title);
    ASSERT_TRUE(comes(percent));
    const std::string before = bench().image().reference.sha256;
    QTest::mouseClick(part<QPushButton>("series_open"), Qt::LeftButton);
    ASSERT_TRUE(wait_until(
        [&] { return bench().image().reference.sha256 != before && !window().jobs().any(); }, 120000));
    EXPECT_EQ(shown_percent(), percent);
    EXPECT_EQ(list().count(), 5) << title.toStdString();
    EXPECT_TRUE(series().strip().isVisible());
    EXPECT_EQ(list().currentRow(), row_of(title));
  };
  work_on("35 %", 35);
  EXPECT_TRUE(testing::open_boxes().empty());
  const auto known = window().machine().find_image(bench().image().reference.sha256);
  ASSERT_TRUE(known);
  EXPECT_EQ(known->path, beside) << "where it is found again";
  work_on("55 %", 55);  // and back to one of the first folder
  EXPECT_EQ(window().machine().find_image(bench().image().reference.sha256)->path, study);
}

TEST_F(StudyWindow, PhasesInFilesStayTheSameStackWhenAnotherIsPutOnTheTable) {
  const fs::path phases = folder / "phases";
  fs::create_directories(phases);
  for (const int percent : {25, 55, 85})
    imaging::write_image(phases / ("phase_" + std::to_string(percent) + ".nrrd"), smeared_tube(percent));
  test = std::make_unique<TestWindow>(folder / "state");
  window().open(phases / "phase_25.nrrd");
  ASSERT_TRUE(wait_until([&] { return !bench().image().reference.sha256.empty(); }, 60000));
  ASSERT_TRUE(idle());
  testing::answer_file_dialog(phases);
  part<QAction>("file.phases")->trigger();
  ASSERT_TRUE(wait_until([&] { return series().choice().has_value(); }, 60000));
  ASSERT_TRUE(idle());
  bool measured_again = false;
  const auto watch = QObject::connect(&window().jobs(), &Jobs::changed, [&] {
    measured_again = measured_again || window().jobs().running("best_phase");
  });
  click("55 %");
  ASSERT_TRUE(comes(55));
  const std::string before = bench().image().reference.sha256;
  QTest::mouseClick(part<QPushButton>("series_open"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return bench().image().reference.sha256 != before && !window().jobs().any(); },
                         120000));
  ASSERT_TRUE(idle());
  QObject::disconnect(watch);
  EXPECT_EQ(shown_percent(), 55);
  EXPECT_TRUE(series().choice().has_value());
  EXPECT_FALSE(measured_again) << "it is the same study";
}

TEST_F(StudyWindow, AnImageFromElsewhereTakesTheStripAway) {
  open_study();
  const fs::path image = folder / "image.nrrd";
  imaging::write_image(image, testing::tube_image());
  window().open(image);
  ASSERT_TRUE(wait_until([&] { return bench().image().volume->geometry.size[2] == 110; }, 60000));
  ASSERT_TRUE(idle());
  EXPECT_FALSE(series().strip().isVisible());
  EXPECT_FALSE(part<QAction>("view.series")->isEnabled());
  // Phases in files say of nobody: the person chooses them.
  const fs::path phases = folder / "phases";
  fs::create_directories(phases);
  for (const int percent : {25, 55, 85})
    imaging::write_image(phases / ("phase_" + std::to_string(percent) + ".nrrd"), smeared_tube(percent));
  testing::answer_file_dialog(phases);
  part<QAction>("file.phases")->trigger();
  ASSERT_TRUE(wait_until([&] { return series().strip().isVisible(); }));
  ASSERT_TRUE(wait_until([&] { return series().choice().has_value(); }, 60000));
  EXPECT_EQ(list().count(), 3);
  EXPECT_EQ(part<QPushButton>("series_best")->text(), "Sharpest: 55 %");
  click("85 %");
  EXPECT_TRUE(comes(85));
  QTest::mouseClick(part<QPushButton>("series_open"), Qt::LeftButton);
  ASSERT_TRUE(wait_until([&] { return bench().image().volume->geometry.size[2] == 60; }, 60000));
  ASSERT_TRUE(idle());
  EXPECT_TRUE(series().strip().isVisible());
  EXPECT_THAT(note_of("85 %").toStdString(), HasSubstr("on the table"));
}

}  // namespace
}  // namespace ostia::workstation
