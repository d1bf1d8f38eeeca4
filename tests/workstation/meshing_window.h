#pragma once
/// \file The window with a small case, and a hand in its export dialogs.

#include "meshing/dialog.h"
#include "tube_window.h"

#include <QTabBar>
#include <QTabWidget>

namespace ostia::workstation::testing {

/// A window with the tube's case open, and a hand in its export dialogs.
class MeshingWindow : public TubeWindow {
 public:
  MeshingDialog* dialog = nullptr;

  explicit MeshingWindow(double narrowing = 0.0) : TubeWindow(narrowing) {}
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
  void click_go() {
    QTest::mouseClick(in_dialog<QPushButton>("go"), Qt::LeftButton);
    QApplication::processEvents();
  }
  QString trouble(const char* field) {
    auto* label = in_dialog<QLabel>((std::string(field) + "_trouble").c_str());
    return label->isVisible() ? label->text() : QString();
  }
};

}  // namespace ostia::workstation::testing
