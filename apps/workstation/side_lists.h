#pragma once
/// \file The lists beside the views: steps that were done, and measurements.

#include "picture_widget.h"

#include "ostia/session/workbench.h"

#include <QListWidget>
#include <QTimer>
#include <QTreeWidget>
#include <vector>

namespace ostia::workstation {

/// In the words of the interface: "Draw on CPR", "Pull the wall", ...
QString step_name(const std::string& op);

/// All steps of the case, the last one done marked; a click goes there.
class StepList final : public QListWidget {
  Q_OBJECT
 public:
  StepList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);

 private:
  void fill();
  session::Workbench& bench_;
  Guard guard_;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

/// Measurements with their values; selects, renames, deletes, goes there.
class MeasurementList final : public QTreeWidget {
  Q_OBJECT
 public:
  MeasurementList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  void go_to(std::int32_t measurement);

 protected:
  void keyPressEvent(QKeyEvent* event) override;

 private:
  void fill();
  void remove_current();
  session::Workbench& bench_;
  Guard guard_;
  bool filling_ = false;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
