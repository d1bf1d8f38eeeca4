#pragma once
/// \file Two scans of one patient side by side, with one cursor, in the place of the window's views.

#include "comparison/twin_views.h"
#include "shell/over_views.h"

#include <vector>

class QComboBox;
class QLabel;
class QListWidget;

namespace ostia::workstation {

class AlongWidget;
class CommandTable;
class Comparing;
class LesionChanges;
struct Desk;

class ComparisonPage final : public OverViews {
  Q_OBJECT
 public:
  ComparisonPage(Desk& desk, QMainWindow& window, Comparing& comparing);
  ~ComparisonPage() override;
  /// Of what can be done; after the table of commands is there.
  void add_buttons(const CommandTable& commands);
  void blink();         ///< the other scan in the place of the one that is shown
  void side_by_side();  ///< both again
  void step_lesion(int by);
  void fit();

 signals:
  void hovered(const QString& text);
  void shown(bool visible);

 protected:
  void showEvent(QShowEvent* event) override;
  void hideEvent(QHideEvent* event) override;

 private:
  QWidget* side();
  QWidget* views();
  void show_twins(TwinsShown shown);
  void fill();
  void fill_state();
  void fill_vessels();
  void show_reached();
  Desk& desk_;
  Comparing& comparing_;
  QLabel* state_ = nullptr;
  QListWidget* notes_ = nullptr;
  QComboBox* vessel_ = nullptr;
  LesionChanges* lesions_ = nullptr;
  AlongWidget* along_ = nullptr;
  TwinViews *curved_ = nullptr, *section_ = nullptr, *slice_ = nullptr;
  QWidget* buttons_ = nullptr;
  TwinsShown twins_ = TwinsShown::both;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
