#pragma once
/// \file The window with a small case, and a hand in its export dialogs.

#include "main_window.h"
#include "meshing_dialog.h"
#include "tube_case.h"
#include "window_hand.h"

#include "ostia/imaging/image_file.h"
#include "ostia/session/case_file.h"
#include "ostia/session/image_digest.h"

#include <gtest/gtest.h>

#include <QAction>
#include <QComboBox>
#include <QLabel>
#include <QLineEdit>
#include <QPushButton>
#include <QTabBar>
#include <QTabWidget>
#include <QTest>
#include <QToolButton>
#include <filesystem>
#include <memory>
#include <string>

namespace ostia::workstation::testing {

namespace fs = std::filesystem;

/// A window with the tube's case open, and a hand in its export dialogs.
class MeshingWindow : public ::testing::Test {
 public:
  Folder folder;
  fs::path image = folder / "image.nrrd", case_file = folder / "tube.ostia";
  std::unique_ptr<TestWindow> test;
  MeshingDialog* dialog = nullptr;

  explicit MeshingWindow(double narrowing = 0.0) {
    imaging::write_image(image, tube_image(narrowing));
    session::CaseFile::create(case_file, tube_model(narrowing), session::image_reference(image));
    session::MachineState(folder / "state").remember_image(session::image_reference(image).sha256, image);
  }
  void open_case() {
    test = std::make_unique<TestWindow>(folder / "state");
    test->open(case_file);
  }
  void ask(const char* command) {
    test->window().findChild<QAction*>(command)->trigger();
    ASSERT_TRUE(wait_until([&] {
      dialog = test->window().findChild<MeshingDialog*>();
      return dialog && dialog->isVisible();
    }));
    ASSERT_TRUE(QTest::qWaitForWindowExposed(dialog));
  }
  template <class Widget>
  Widget* in_dialog(const char* name) {
    auto* found = dialog->findChild<Widget*>(name);
    EXPECT_TRUE(found) << name;
    if (found) open_page_of(found);
    return found;
  }
  /// Clicks the tab of the page that a field is on.
  void open_page_of(QWidget* field) {
    auto* pages = dialog->findChild<QTabWidget*>("pages");
    for (int i = 0; pages && i < pages->count(); ++i) {
      if (!pages->widget(i)->isAncestorOf(field) || pages->currentIndex() == i) continue;
      QTest::mouseClick(pages->tabBar(), Qt::LeftButton, Qt::NoModifier,
                        pages->tabBar()->tabRect(i).center());
      QApplication::processEvents();
      EXPECT_EQ(pages->currentIndex(), i);
    }
  }
  /// Clicks into the field, selects all and types.
  static void type(QWidget* field, const QString& text) {
    auto* line = qobject_cast<QLineEdit*>(field);
    if (!line) line = field->findChild<QLineEdit*>();
    QTest::mouseClick(line, Qt::LeftButton);
    QTest::keyClick(line, Qt::Key_A, Qt::ControlModifier);
    QTest::keyClicks(line, text);
    QApplication::processEvents();
  }
  /// By the keys of a combo box, as a person does.
  static void pick(QComboBox* box, int index) {
    box->setFocus();
    QTest::keyClick(box, Qt::Key_Home);
    for (int i = 0; i < index; ++i) QTest::keyClick(box, Qt::Key_Down);
    EXPECT_EQ(box->currentIndex(), index);
  }
  void click_go() {
    QTest::mouseClick(in_dialog<QPushButton>("go"), Qt::LeftButton);
    QApplication::processEvents();
  }
  QString trouble(const char* field) {
    auto* label = in_dialog<QLabel>((std::string(field) + "_trouble").c_str());
    return label->isVisible() ? label->text() : QString();
  }
  bool idle() { return !test->window().jobs().any(); }
  QString left_line(const char* kind) {
    auto* line = test->window().jobs().findChild<QWidget*>(QStringLiteral("left.%1").arg(kind));
    auto* label = line ? line->findChild<QLabel*>() : nullptr;
    return label ? label->text() : QString();
  }
};

}  // namespace ostia::workstation::testing
