#pragma once
/// \file The list of the steps that were done.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

#include <QListWidget>
#include <QTimer>
#include <string>
#include <vector>

namespace ostia::workstation {

/// In the words of the interface: "Draw on CPR", "Pull the wall", ...
QString step_name(const std::string& op);

/// All steps of the case, the last one done in bold; a click, or Return, goes there.
class StepList final : public QListWidget {
  Q_OBJECT
 public:
  StepList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void fill();
  void go_to(const QListWidgetItem& step);
  void select_last();
  session::Workbench& bench_;
  Guard guard_;
  QListWidgetItem* last_ = nullptr;  // done
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
