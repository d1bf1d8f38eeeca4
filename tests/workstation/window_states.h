#pragma once
/// \file The states of the window that are looked at and measured, each on a small case of its own.

#include "window_hand.h"

#include <QImage>
#include <memory>
#include <string>
#include <vector>

namespace ostia::workstation::testing {

/// Before the application: a font, its rendering and a scale that are the same on every machine with the
/// packages of scripts/packages.txt, and nothing of the user's own settings. Throws std::runtime_error where
/// the font is missing.
void pin_fonts(const Folder& folder);
/// With the application: the font's size, no blinking, no pictures of the desktop's theme.
void pin_look();

/// A window with its case, image and truth in a temporary folder, at the screen's upper left corner.
class Stage {
 public:
  explicit Stage(const QSize& size);
  ~Stage();
  MainWindow& window() { return *window_; }
  /// Brings the window into one of the states. Throws std::runtime_error where it does not get there.
  void enter(const std::string& state);
  /// Of a case that is open: all that views can write over their pictures, at once.
  void crowd();
  /// One view alone, or all again.
  void show_alone(const char* view);
  /// What the screen shows of the window, once it has stopped changing. Throws std::runtime_error where it
  /// goes on.
  QImage settled();

 private:
  void open_case();
  void run(const char* command);
  void open_series();
  void measure();
  void edit();
  void open_truth();
  Folder folder_;
  QSize size_;
  std::unique_ptr<MainWindow> window_;
};

std::vector<std::string> window_states();

}  // namespace ostia::workstation::testing
