#pragma once
/// \file The page of the calcium score: the total, the arteries, the lesions.

#include "ostia/analysis/calcium_score.h"
#include "ostia/session/signal.h"

#include <QDockWidget>
#include <vector>

class QCheckBox;
class QDoubleSpinBox;
class QLabel;
class QTreeWidget;

namespace ostia::workstation {

class Calcium;
class CommandTable;
struct Desk;

/// Open, lesions are shown on the slices of the scan; put away, they are not.
class CalciumPage final : public QDockWidget {
  Q_OBJECT
 public:
  CalciumPage(Desk& desk, Calcium& calcium);
  /// Of what can be done; after the table of commands is there.
  void add_buttons(const CommandTable& commands);

 private:
  QWidget* calibration_row();
  void fill();
  void fill_total();
  void fill_vessels();
  void fill_lesions();
  void show_chosen();
  void hide_what_is_not_wanted();
  bool is_wanted(const analysis::CalciumLesion& lesion) const;
  Desk& desk_;
  Calcium& calcium_;
  QLabel *total_ = nullptr, *state_ = nullptr;
  QTreeWidget *vessels_ = nullptr, *lesions_ = nullptr;
  QCheckBox* all_ = nullptr;
  QDoubleSpinBox* calibration_ = nullptr;
  QWidget* buttons_ = nullptr;
  bool filling_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
