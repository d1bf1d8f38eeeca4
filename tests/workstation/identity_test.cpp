// Whose images these are: on the window, on this machine, and nowhere else unless it is asked for.

#include "measuring/reporting.h"
#include "opening/start_page.h"
#include "shell/preferences_dialog.h"
#include "tube_case.h"
#include "views/picture_widget.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <QAction>
#include <QCheckBox>
#include <QDialogButtonBox>
#include <QMenu>
#include <QPushButton>
#include <QTest>
#include <string_view>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using ::testing::Not;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;

struct WhoIsIt : ::testing::Test {
  testing::Folder folder;
  fs::path state = folder / "state", dicom = folder / "scan", case_file = folder / "a.ostia";
  std::unique_ptr<TestWindow> test;
  WhoIsIt() {
    imaging::DicomSeriesOptions options;
    options.patient_name = "DOE^JANE";
    options.patient_id = "PID-4711";
    options.series_description = "CTA thin";
    imaging::write_dicom_series(dicom, tube_image(), options);
    start();
    open(dicom);
    session::CaseFile::create(case_file, tube_model(), test->bench().image().reference);
  }
  void start() {
    if (test) test->window().close();  // else it would open the case again by itself
    test.reset();
    test = std::make_unique<TestWindow>(state);
  }
  void open(const fs::path& what) {
    test->window().open(what);
    ASSERT_TRUE(wait_until([&] { return !test->window().jobs().any(); }, 60000));
    QApplication::processEvents();
  }
  std::string title() { return test->window().windowTitle().toStdString(); }
  template <class Widget>
  Widget* child(const char* name) {
    return test->window().findChild<Widget*>(name);
  }
  /// Pixels of the view's lower left corner that a name changes.
  bool named(PictureWidget& view) {
    const QImage shown = view.grab().toImage(), plain = view.picture_of_nobody();
    const QRect corner(0, view.height() / 2, view.width() / 2, view.height() / 2);
    return shown.copy(corner) != plain.copy(corner);
  }
  std::vector<std::string> recent() {
    QMenu* menu = nullptr;
    for (QMenu* one : test->window().findChildren<QMenu*>())
      if (one->title().contains("ecent")) menu = one;
    emit menu->aboutToShow();
    std::vector<std::string> texts;
    for (const QAction* action : menu->actions()) texts.push_back(action->text().toStdString());
    return texts;
  }
  /// Pictures within a page are letters, too, and four of them may spell a name by chance.
  static std::string without_pictures(std::string text) {
    constexpr std::string_view before = "base64,";
    for (std::size_t at = text.find(before); at != std::string::npos; at = text.find(before, at)) {
      at += before.size();
      text.erase(at, text.find_first_of("\"')", at) - at);
    }
    return text;
  }
  /// Files below the folder, but for the scan itself, whose bytes name the patient.
  std::vector<std::string> naming() {
    std::vector<std::string> found;
    for (const fs::directory_entry& one : fs::recursive_directory_iterator(folder / "")) {
      if (!one.is_regular_file() || one.path().string().find("/scan/") != std::string::npos) continue;
      const std::string bytes = without_pictures(core::read_file(one.path(), 1U << 28));
      for (const char* word : {"Jane", "JANE", "4711"})
        if (bytes.find(word) != std::string::npos) {
          found.push_back(one.path().filename().string());
          break;
        }
    }
    return found;
  }
  /// The report by its command; `named`: the box is ticked, which was empty before.
  fs::path report(bool named, const std::string& name) {
    child<QAction>("file.report")->trigger();
    QDialog* dialog = nullptr;  // one that was closed may not be gone yet
    for (auto* one : test->window().findChildren<QDialog*>("report"))
      if (one->isVisible()) dialog = one;
    EXPECT_TRUE(dialog);
    auto* box = dialog->findChild<QCheckBox*>("named");
    EXPECT_FALSE(box->isChecked());
    if (named) QTest::mouseClick(box, Qt::LeftButton, {}, QPoint(8, box->height() / 2));
    EXPECT_EQ(box->isChecked(), named);
    for (QPushButton* button : dialog->findChildren<QPushButton*>())
      if (button->isDefault()) QTest::mouseClick(button, Qt::LeftButton);
    EXPECT_TRUE(wait_until([&] { return !test->window().jobs().any(); }, 60000));
    testing::message();
    EXPECT_TRUE(fs::exists(folder / name / "report.pdf"));
    return folder / name;
  }
};

TEST_F(WhoIsIt, StandsInTheTitleAndInTheCornersOfImages) {
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  EXPECT_THAT(title(), HasSubstr("PID-4711"));
  EXPECT_THAT(title(), HasSubstr("CTA thin"));
  open(case_file);
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  for (const char* view : {"slice", "section", "cpr1", "cpr2"})
    EXPECT_TRUE(named(test->picture(view))) << view;
  EXPECT_FALSE(named(test->picture("strip1")));
}

TEST_F(WhoIsIt, IsSwitchedInMenuAndPreferencesAndRemembered) {
  open(case_file);
  child<QAction>("view.identity")->trigger();
  EXPECT_FALSE(named(test->picture("slice")));
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  start();
  open(case_file);
  EXPECT_FALSE(child<QAction>("view.identity")->isChecked());
  EXPECT_FALSE(named(test->picture("slice")));
  child<QAction>("edit.preferences")->trigger();
  auto* box = child<QCheckBox>("identity_on_views");
  ASSERT_TRUE(box);
  EXPECT_FALSE(box->isChecked());
  box->click();
  EXPECT_TRUE(child<QAction>("view.identity")->isChecked());
  EXPECT_TRUE(named(test->picture("slice")));
}

TEST_F(WhoIsIt, IsInTheListOfRecentCasesOfThisMachine) {
  open(case_file);
  ASSERT_FALSE(recent().empty());
  EXPECT_THAT(recent()[0], HasSubstr("DOE, JANE"));
  EXPECT_THAT(recent()[0], HasSubstr("a.ostia"));
  test->window().close();
  start();
  EXPECT_THAT(recent()[0], HasSubstr("DOE, JANE"));
  EXPECT_THAT(
      child<StartPage>("start_page")->findChildren<QPushButton*>().back()->accessibleName().toStdString(),
      HasSubstr("DOE, JANE"));
  // A case whose scan is away still says whose it is.
  fs::rename(dicom, folder / "scan-moved");
  test->window().open(case_file);
  ASSERT_TRUE(wait_until([&] { return test->bench().has_case() && !test->window().jobs().any(); }));
  testing::message();
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  fs::rename(folder / "scan-moved", dicom);
}

TEST_F(WhoIsIt, GoesFromThisMachineWhenThePreferenceSaysSo) {
  open(case_file);
  struct stat status {};
  ASSERT_EQ(::stat((state / "patients.json").c_str(), &status), 0);
  EXPECT_EQ(status.st_mode & 0777U, 0600U);
  child<QAction>("edit.preferences")->trigger();
  child<QCheckBox>("identity_kept")->click();
  EXPECT_FALSE(fs::exists(state / "patients.json"));
  EXPECT_THAT(title(), HasSubstr("DOE, JANE")) << "what is open is still known";
  start();
  ASSERT_TRUE(wait_until([&] { return !test->window().jobs().any(); }, 60000));
  EXPECT_THAT(recent()[0], Not(HasSubstr("JANE")));
  open(case_file);
  open(dicom);
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  EXPECT_FALSE(fs::exists(state / "patients.json"));
}

TEST_F(WhoIsIt, IsInNoCaseLogOrExportButInAReportThatIsAskedForIt) {
  ::testing::internal::CaptureStderr();
  open(case_file);
  test->window().reporting().pin(test->picture("slice"));
  const fs::path plain = report(false, "a-report");
  test->bench().edit(lumen::VesselRename{4, "RCA"});
  test->window().close();
  EXPECT_THAT(naming(), ::testing::ElementsAre("patients.json"));
  start();
  open(case_file);
  test->window().reporting().pin(test->picture("slice"));
  report(true, "a-report-2");
  EXPECT_THAT(naming(), ::testing::UnorderedElementsAre("patients.json", "report.html"))
      << "the PDF is packed: its bytes do not show the name";
  EXPECT_NE(core::read_file(folder / "a-report-2" / "report.pdf", 1U << 28),
            core::read_file(plain / "report.pdf", 1U << 28));
  report(false, "a-report-3");  // the box is empty again
  const std::string logged = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(logged.find("JANE"), std::string::npos) << logged;
  EXPECT_EQ(logged.find("4711"), std::string::npos) << logged;
}

TEST_F(WhoIsIt, IsThatOfTheImageOnTheTable) {
  imaging::DicomSeriesOptions options;
  options.patient_name = "ROE^RICHARD";
  options.patient_id = "R2";
  imaging::ImageVolume other = tube_image();
  other.voxels[5] = 17;
  imaging::write_dicom_series(folder / "other", other, options);
  open(folder / "other");
  EXPECT_THAT(title(), HasSubstr("ROE, RICHARD"));
  EXPECT_THAT(title(), Not(HasSubstr("JANE")));
  open(case_file);
  EXPECT_THAT(title(), HasSubstr("DOE, JANE"));
  EXPECT_THAT(title(), Not(HasSubstr("RICHARD")));
  child<QAction>("file.close")->trigger();
  test->bench().close_image();
  EXPECT_EQ(title(), "Ostia");
}

}  // namespace
}  // namespace ostia::workstation
