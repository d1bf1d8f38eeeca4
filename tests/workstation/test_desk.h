#pragma once
/// \file A desk without the program's window: what parts of it are tested on.

#include "hand.h"
#include "shell/desk.h"

#include <QMainWindow>

namespace ostia::workstation::testing {

/// A plain window with a desk, and the last line that was said.
class TestDesk {
 public:
  explicit TestDesk(const std::filesystem::path& state_folder)
      : desk_(window_, state_folder, [this](const QString& text) { said_ = text; }) {
    window_.resize(1000, 700);
  }
  /// In front, with the keyboard. Throws std::runtime_error where it does not come up.
  void show() {
    window_.show();
    window_.activateWindow();
    if (!wait_until([this] { return window_.isActiveWindow(); })) throw std::runtime_error("no window");
  }
  /// Lets the jobs end.
  bool idle() {
    return wait_until([this] { return !desk_.jobs.any(); }, 60000);
  }
  QMainWindow& window() { return window_; }
  Desk& desk() { return desk_; }
  session::Workbench& bench() { return desk_.bench; }
  std::string said() const { return said_.toStdString(); }

 private:
  QString said_;
  QMainWindow window_;
  Desk desk_;
};

}  // namespace ostia::workstation::testing
