// What stands in the views' place when something fails, and what was said before.

#include "commands/table.h"
#include "measuring/reporting.h"
#include "opening/series_browser.h"
#include "opening/start_page.h"
#include "shell/failure_panel.h"
#include "shell/language.h"
#include "shell/library_texts.h"
#include "shell/messages_dialog.h"
#include "tube_case.h"
#include "vessels/finder.h"
#include "window_hand.h"

#include "ostia/core/files.h"
#include "ostia/imaging/dicom_writer.h"
#include "ostia/imaging/image_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <QLabel>
#include <QPlainTextEdit>
#include <QPushButton>
#include <QTest>
#include <QWindow>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;
using testing::open_boxes;
using testing::TestWindow;
using testing::tube_image;
using testing::tube_model;
using testing::wait_until;

struct Failing : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "tube.nrrd", case_file = folder / "tube.ostia";
  TestWindow test{folder / "state"};
  Failing() {
    imaging::write_image(image, tube_image());
    session::CaseFile::create(case_file, tube_model(), {});
  }
  MainWindow& window() { return test.window(); }
  void open(const fs::path& what) {
    window().open(what);
    ASSERT_TRUE(wait_until([&] { return !window().jobs().any(); }, 60000));
    QApplication::processEvents();
  }
  template <class Widget>
  Widget& child(const char* name) {
    auto* found = window().findChild<Widget*>(name);
    if (!found) throw std::runtime_error(std::string("the window has no ") + name);
    return *found;
  }
  bool panel_shown() { return child<FailurePanel>("failure").isVisible(); }
  std::string title() { return child<QLabel>("failure_title").text().toStdString(); }
  std::string reason() { return child<QLabel>("failure_reason").text().toStdString(); }
  /// A button that can be seen and clicked; null: there is none.
  QPushButton* way(const QString& id) {
    for (auto* one : child<FailurePanel>("failure").findChildren<QPushButton*>("way." + id))
      if (one->isVisible()) return one;
    return nullptr;
  }
  void click(const QString& id) {
    QPushButton* button = way(id);
    ASSERT_TRUE(button) << id.toStdString();
    QTest::mouseClick(button, Qt::LeftButton);
    QApplication::processEvents();
  }
};

TEST_F(Failing, WithoutAnAortaTheReasonStandsInPlaceOfTheViewsWithTheWaysOut) {
  open(image);
  ASSERT_TRUE(panel_shown());
  EXPECT_EQ(title(), "The arteries were not found by themselves");
  EXPECT_FALSE(reason().empty());
  EXPECT_TRUE(test.picture("slice").isVisible());
  EXPECT_TRUE(way("view.layout_planes"));
  EXPECT_TRUE(way("help.messages"));
  EXPECT_FALSE(way("file.series")) << "a file has no other series";
  click("tool.add_artery");
  EXPECT_EQ(test.bench().tool.get(), session::Tool::add_artery);
  EXPECT_THAT(child<QLabel>("failure_waiting").text().toStdString(), HasSubstr("ostium"));
  window().finder().find_vessel({0.0, 0.0, 3.0});
  EXPECT_THAT(child<QLabel>("failure_waiting").text().toStdString(), HasSubstr("distal"));
  window().finder().find_vessel({0.0, 0.0, 36.0});
  ASSERT_TRUE(wait_until([&] { return test.bench().has_case(); }));
  QApplication::processEvents();
  EXPECT_FALSE(panel_shown());
  EXPECT_TRUE(open_boxes().empty());
}

TEST_F(Failing, ThreePlanesAreAWayOut) {
  open(image);
  click("view.layout_planes");
  EXPECT_TRUE(child<QWidget>("planes").isVisible());
  EXPECT_FALSE(panel_shown()) << "its views are not there";
}

TEST_F(Failing, ItsButtonsStayAsLongAsWhatTheyOfferDoes) {
  open(image);
  QPushButton* before = way("tool.add_artery");
  ASSERT_TRUE(before);
  before->setFocus();
  QTest::mousePress(before, Qt::LeftButton);
  bool done = false;
  window().jobs().run(
      "other", "Other", [](const core::TaskContext&) { return std::any(1); },
      [&](const std::any&) { done = true; }, [](const QString&) {});
  ASSERT_TRUE(wait_until([&] { return done; }));
  QApplication::processEvents();
  ASSERT_EQ(way("tool.add_artery"), before) << "a job that has nothing to do with it";
  QTest::mouseRelease(before, Qt::LeftButton);
  EXPECT_EQ(test.bench().tool.get(), session::Tool::add_artery) << "a click goes on over the end of a job";
  window().commands().action("view.layout_planes").setEnabled(false);
  test.bench().tool.set(session::Tool::browse);
  EXPECT_FALSE(way("view.layout_planes")) << "what it offers has changed";
  EXPECT_TRUE(way("tool.add_artery"));
}

TEST_F(Failing, ACaseOfANewerVersionIsOneClearMessage) {
  std::string bytes = core::read_file(case_file);
  bytes[63] = 99;  // SQLite's user_version, big-endian
  core::write_file(case_file, bytes);
  open(case_file);
  ASSERT_TRUE(panel_shown());
  EXPECT_TRUE(open_boxes().empty());
  EXPECT_EQ(title(), "The case cannot be opened");
  EXPECT_THAT(reason(), HasSubstr("newer than this program's"));
  EXPECT_THAT(reason(), HasSubstr("open it with Ostia"));
  EXPECT_FALSE(child<StartPage>("start_page").isVisible());
  for (const char* id : {"file.open", "file.open_folder", "file.sample"}) EXPECT_TRUE(way(id)) << id;
}

TEST_F(Failing, WhatCannotBeReadIsSaidThereUntilSomethingElseIsOpened) {
  core::write_file(folder / "broken.nrrd", "no image at all");
  open(folder / "broken.nrrd");
  ASSERT_TRUE(panel_shown());
  EXPECT_THAT(title(), HasSubstr("cannot be opened"));
  open(folder / "not-there.nrrd");
  EXPECT_THAT(reason(), HasSubstr("not-there.nrrd"));
  open(case_file);
  EXPECT_FALSE(panel_shown());
  core::write_file(folder / "broken.ostia", "no case");
  open(folder / "broken.ostia");
  EXPECT_FALSE(panel_shown()) << "what is open stays to be seen";
  EXPECT_THAT(testing::message(), HasSubstr("broken.ostia"));
  EXPECT_TRUE(test.bench().has_case());
}

TEST_F(Failing, AnImageWithoutAVesselIsNeverAnEmptyWindow) {
  bool looked_for = false;  // the search of so small an image is over in a moment
  const auto cancel = QObject::connect(&window().jobs(), &Jobs::changed, [&] {
    if (looked_for || !window().jobs().running("tree")) return;
    looked_for = true;
    EXPECT_FALSE(panel_shown()) << "they are being looked for";
    window().jobs().cancel("tree");
  });
  window().open(image);
  ASSERT_TRUE(wait_until([&] { return looked_for; }));
  QObject::disconnect(cancel);
  ASSERT_TRUE(wait_until([&] { return !window().jobs().any(); }, 60000));
  QApplication::processEvents();
  ASSERT_TRUE(panel_shown());
  EXPECT_EQ(title(), "No vessel yet");
  click("vessel.find");
  ASSERT_TRUE(wait_until([&] { return !window().jobs().any(); }, 60000));
  QApplication::processEvents();
  EXPECT_EQ(title(), "The arteries were not found by themselves");
}

TEST_F(Failing, OfAFolderAnotherSeriesCanBeChosen) {
  imaging::DicomSeriesOptions options;
  options.series_description = "CTA thin";
  imaging::write_dicom_series(folder / "scan", tube_image(), options);
  open(folder / "scan");
  ASSERT_TRUE(panel_shown());
  click("file.series");
  ASSERT_TRUE(wait_until([&] { return window().findChild<SeriesBrowser*>("series") != nullptr; }, 60000));
  child<SeriesBrowser>("series").reject();
}

TEST_F(Failing, WhatWasSaidCanBeReadAgain) {
  open(image);
  window().complain("There is no file or folder lad.ostia.", "The case cannot be opened");
  testing::message();
  window().activateWindow();
  ASSERT_TRUE(QTest::qWaitForWindowActive(&window()));
  QTest::keyClick(window().windowHandle(), Qt::Key_L, Qt::ControlModifier | Qt::ShiftModifier);
  ASSERT_TRUE(wait_until([&] { return window().findChild<MessagesDialog*>("messages") != nullptr; }));
  auto& text = child<QPlainTextEdit>("messages_text");
  EXPECT_THAT(text.toPlainText().toStdString(), HasSubstr("The arteries were not found by themselves"));
  EXPECT_THAT(text.toPlainText().toStdString(),
              HasSubstr("The case cannot be opened: There is no file or folder lad.ostia."));
  window().desk().messages.say("one more");
  EXPECT_TRUE(text.toPlainText().endsWith("one more"));
  for (std::size_t i = 0; i < Messages::most_kept + 10; ++i) window().desk().messages.say(QString::number(i));
  EXPECT_EQ(window().desk().messages.log().size(), Messages::most_kept);
}

TEST_F(Failing, APdfThatNoProgramOpensIsSaid) {
  open(case_file);
  const QByteArray path = qgetenv("PATH");
  core::write_file(folder / "xdg-open", "#!/bin/sh\nexit 3\n");
  ASSERT_EQ(::chmod((folder / "xdg-open").c_str(), 0755), 0);
  qputenv("PATH", QByteArray::fromStdString((folder / "").string()) + ":" + path);
  window().reporting().make_report_in(folder / "out");
  const auto told = [&] { return window().findChild<QMessageBox*>("report_made"); };
  ASSERT_TRUE(wait_until([&] { return told() && told()->isVisible(); }, 120000));
  QTest::mouseClick(&child<QPushButton>("report_made.report.pdf"), Qt::LeftButton);
  EXPECT_TRUE(wait_until([&] {
    for (const QMessageBox* box : open_boxes())
      if (box->text().contains("no program that opens it") && box->text().contains("report.pdf")) return true;
    return false;
  }));
  qputenv("PATH", path);
  for (QMessageBox* box : open_boxes()) box->close();
}

/// Each in a process of its own: a language is there for good.
TEST(FailingInGerman, ReasonsAndWaysAreGerman) {
  use_language("de");
  testing::Folder folder;
  imaging::write_image(folder / "tube.nrrd", tube_image());
  session::CaseFile::create(folder / "tube.ostia", tube_model(), {});
  std::string bytes = core::read_file(folder / "tube.ostia");
  bytes[63] = 99;
  core::write_file(folder / "tube.ostia", bytes);
  TestWindow test(folder / "state");
  const auto reason = [&](const fs::path& what) {
    test.window().open(what);
    wait_until([&] { return !test.window().jobs().any(); }, 60000);
    QApplication::processEvents();
    return test.window().findChild<QLabel*>("failure_reason")->text().toStdString();
  };
  const std::string newer = reason(folder / "tube.ostia");
  EXPECT_THAT(newer, HasSubstr("neuer"));
  EXPECT_THAT(newer, ::testing::Not(HasSubstr("newer")));
  const std::string not_found = reason(folder / "tube.nrrd");
  EXPECT_THAT(not_found, ::testing::Not(HasSubstr("image"))) << not_found;
  EXPECT_THAT(test.window().findChild<QLabel*>("failure_title")->text().toStdString(),
              HasSubstr("Arterien wurden nicht"));
}

}  // namespace
}  // namespace ostia::workstation
