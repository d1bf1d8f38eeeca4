#pragma once
/// \file The list of the steps that were done.

#include "views/picture_widget.h"

#include "ostia/session/workbench.h"

#include <QListWidget>
#include <QTimer>
#include <map>
#include <string>
#include <vector>

namespace ostia::workstation {

/// In the words of the interface: "Draw on CPR", "Pull the wall", ...
QString step_name(const std::string& op);

/// All steps of the case with their vessel, time of day and, where it was said, who did them; the last one
/// done in bold. A click, or Return, goes there.
class StepList final : public QListWidget {
  Q_OBJECT
 public:
  StepList(session::Workbench& bench, Guard guard, QWidget* parent = nullptr);
  QWidget* with_filter();  ///< the list below a line that filters it, to be shown instead of it

 protected:
  void focusOutEvent(QFocusEvent* event) override;

 private:
  void fill();
  void filter();
  QString vessel_of(const session::JournalEntry& step);
  void go_to(const QListWidgetItem& step);
  void select_last();
  session::Workbench& bench_;
  Guard guard_;
  QListWidgetItem* last_ = nullptr;               // done
  std::map<std::int64_t, std::int32_t> vessels_;  // by step, so that each is looked at once; -1: none
  QString wanted_;                                // text that a row must have
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
