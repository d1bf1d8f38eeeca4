// What a person says of the report, in its dialog: typed, chosen, kept in the case, taken back, signed.

#include "measuring/report_notes_dialog.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/image_digest.h"
#include "ostia/session/machine_state.h"

#include <gmock/gmock.h>

#include <QAction>
#include <QCheckBox>
#include <QComboBox>
#include <QDialogButtonBox>
#include <QLabel>
#include <QLineEdit>
#include <QPlainTextEdit>
#include <QPointer>
#include <QPushButton>
#include <QTest>
#include <QTreeWidget>

namespace ostia::workstation {
namespace {

namespace fs = std::filesystem;
using ostia::workstation::testing::wait_until;
using ::testing::HasSubstr;
using ::testing::SizeIs;
using ::testing::StartsWith;

struct ReportNotesWindow : ::testing::Test {
  testing::Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia", state = folder / "state";
  std::unique_ptr<testing::TestWindow> test;

  ReportNotesWindow() {
    imaging::write_image(image, testing::tube_image(0.5));
    session::CaseFile::create(case_file, testing::tube_model(0.5), session::image_reference(image));
    session::MachineState(state).remember_image(session::image_reference(image).sha256, image);
    test = std::make_unique<testing::TestWindow>(state);
    test->open(case_file);
  }
  const session::ReportNotes& notes() { return test->bench().session().file().annotations()->report; }
  /// Opened by its command, with all that is found.
  QDialog* opened() {
    test->window().findChild<QAction*>("file.report_notes")->trigger();
    QDialog* dialog = nullptr;  // one that was closed may not be gone yet
    for (auto* one : test->window().findChildren<QDialog*>("report_notes"))
      if (one->isVisible()) dialog = one;
    if (dialog) {
      EXPECT_TRUE(wait_until([&] { return part<QPushButton>(dialog, "draft")->isEnabled(); }, 60000));
    }
    return dialog;
  }
  template <class Part>
  static Part* part(QDialog* dialog, const char* name) {
    return dialog->findChild<Part*>(QString::fromLatin1(name));
  }
  static void press(QDialog* dialog, QDialogButtonBox::StandardButton button) {
    QTest::mouseClick(dialog->findChild<QDialogButtonBox*>()->button(button), Qt::LeftButton);
  }
};

TEST_F(ReportNotesWindow, WhatIsTypedAndChosenIsInTheCaseAndTakenBackStepByStep) {
  QPointer<QDialog> dialog = opened();
  ASSERT_TRUE(dialog);
  EXPECT_THAT(part<QLabel>(dialog, "report_found")->text().toStdString(), HasSubstr("CAD-RADS"));
  QTest::keyClicks(part<QPlainTextEdit>(dialog, "impression"), "My own words");
  auto* stent = part<QCheckBox>(dialog, "stent");
  QTest::mouseClick(stent, Qt::LeftButton, {}, QPoint(8, stent->height() / 2));
  QTest::keyClick(part<QComboBox>(dialog, "ischaemia"), Qt::Key_End);
  QTest::keyClicks(part<QLineEdit>(dialog, "agatston"), "312.5");
  press(dialog, QDialogButtonBox::Ok);
  EXPECT_TRUE(!dialog || !dialog->isVisible());
  EXPECT_EQ(notes().impression, "My own words");
  EXPECT_TRUE(notes().modifiers.stent);
  EXPECT_EQ(notes().modifiers.ischaemia, analysis::Ischaemia::positive);
  EXPECT_EQ(notes().modifiers.agatston, 312.5);
  EXPECT_FALSE(notes().modifiers.burden || notes().modifiers.seen);
  ASSERT_TRUE(test->bench().undo());
  EXPECT_EQ(notes().modifiers, session::ReportModifiers{});
  EXPECT_EQ(notes().impression, "My own words");
  ASSERT_TRUE(test->bench().undo());
  EXPECT_EQ(notes(), session::ReportNotes{});
}

TEST_F(ReportNotesWindow, CancelKeepsNothingAndTheDraftOverwritesNothing) {
  QPointer<QDialog> dialog = opened();
  ASSERT_TRUE(dialog);
  auto* text = part<QPlainTextEdit>(dialog, "impression");
  QTest::keyClicks(text, "Mine");
  QTest::mouseClick(part<QPushButton>(dialog, "draft"), Qt::LeftButton);
  EXPECT_THAT(text->toPlainText().toStdString(), StartsWith("Mine\nCAD-RADS"));
  press(dialog, QDialogButtonBox::Cancel);
  EXPECT_EQ(notes(), session::ReportNotes{});
}

TEST_F(ReportNotesWindow, AFeatureIsAcceptedAndTheVersionSigned) {
  QPointer<QDialog> dialog = opened();
  ASSERT_TRUE(dialog);
  auto* features = part<QTreeWidget>(dialog, "features");
  ASSERT_GE(features->topLevelItemCount(), 4) << "four features of each lesion whose outer wall was found";
  auto* word = qobject_cast<QComboBox*>(features->itemWidget(features->topLevelItem(0), 4));
  ASSERT_TRUE(word);
  QTest::keyClick(word, Qt::Key_Down);  // yes
  QTest::mouseClick(part<QPushButton>(dialog, "sign"), Qt::LeftButton);
  testing::message();  // nobody has signed
  EXPECT_TRUE(dialog->isVisible());
  EXPECT_THAT(notes().versions, SizeIs(0));
  QTest::keyClicks(part<QLineEdit>(dialog, "signer"), "Dr. A");
  QTest::mouseClick(part<QPushButton>(dialog, "sign"), Qt::LeftButton);
  EXPECT_TRUE(!dialog || !dialog->isVisible());
  ASSERT_THAT(notes().features, SizeIs(1));
  EXPECT_EQ(notes().features[0].state, session::LesionState::accepted);
  ASSERT_THAT(notes().versions, SizeIs(1));
  EXPECT_EQ(notes().versions[0].signer, "Dr. A");
  dialog = opened();
  ASSERT_TRUE(dialog);
  word =
      qobject_cast<QComboBox*>(part<QTreeWidget>(dialog, "features")
                                   ->itemWidget(part<QTreeWidget>(dialog, "features")->topLevelItem(0), 4));
  EXPECT_EQ(word->currentIndex(), 1) << "it is shown as it was said";
  press(dialog, QDialogButtonBox::Cancel);
}

}  // namespace
}  // namespace ostia::workstation
