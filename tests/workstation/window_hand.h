#pragma once
/// \file The program's window for tests, and a hand that moves over it.

#include "hand.h"
#include "shell/main_window.h"

#include <QLabel>

namespace ostia::workstation::testing {

class TestWindow {
 public:
  explicit TestWindow(const std::filesystem::path& state_folder) : window_(state_folder) {
    window_.resize(1600, 1150);
    window_.show();
    QApplication::processEvents();
  }
  /// Throws std::runtime_error where it is not open in time.
  void open(const std::filesystem::path& case_file) {
    window_.open(case_file);
    if (!wait_until([&] { return bench().has_case() && !window_.jobs().any(); }))
      throw std::runtime_error("the case was not opened");
    QApplication::processEvents();
  }
  /// Why nothing can be shown, once the panel in place of the views says so.
  std::string failure() {
    auto* reason = window_.findChild<QLabel*>("failure_reason");
    if (!reason || !wait_until([&] { return reason->isVisible(); })) return "no failure";
    return reason->text().toStdString();
  }
  MainWindow& window() { return window_; }
  session::Workbench& bench() { return window_.bench(); }
  PictureWidget& picture(const char* name) {
    auto* found = window_.findChild<PictureWidget*>(name);
    if (!found) throw std::runtime_error(std::string("the window has no view ") + name);
    return *found;
  }

 private:
  MainWindow window_;
};

}  // namespace ostia::workstation::testing
