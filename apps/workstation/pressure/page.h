#pragma once
/// \file The page of pressures: the sentence on research use, FFR at the cursor, narrowings, what if, ends of
/// vessels, marks, inputs.

#include "pressure/inputs.h"

#include <QDockWidget>
#include <QTimer>
#include <string>
#include <vector>

class QLabel;
class QListWidget;
class QTreeWidget;

namespace ostia::workstation {

class CommandTable;
struct Desk;
class Pressures;

/// Open, it has pressures computed and shown in all views; put away, none is shown anywhere. So the sentence
/// is on the screen with each of them.
class PressurePage final : public QDockWidget {
  Q_OBJECT
 public:
  PressurePage(Desk& desk, Pressures& pressures);
  /// Of what can be done; after the table of commands is there.
  void add_buttons(const CommandTable& commands);

 private:
  QWidget* readings();
  QWidget* what_if_rows();
  void show_cursor();
  void fill();
  void fill_lesions(const session::PressureReport& now);
  void fill_outlets(const session::PressureReport& now);
  void fill_stretches();
  Desk& desk_;
  Pressures& pressures_;
  PressureGuard guard_;
  QLabel *at_cursor_ = nullptr, *state_ = nullptr;
  QTreeWidget *lesions_ = nullptr, *outlets_ = nullptr, *stretches_ = nullptr;
  QListWidget* marks_ = nullptr;
  QWidget* buttons_ = nullptr;
  QTimer soon_;
  std::vector<std::string> shown_marks_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
