#pragma once
/// \file The inputs of the pressures, each with its range and source.

#include "shell/messages.h"

#include "ostia/session/pressure_board.h"

#include <QTreeWidget>
#include <functional>
#include <vector>

namespace ostia::workstation {

using PressureGuard = std::function<void(const std::function<void()>& act)>;

/// A row an input: a value that is typed is a step of the case, none is the usual one.
class PressureInputs final : public QTreeWidget {
  Q_OBJECT
 public:
  enum Column { name_column, value_column, unit_column, usual_column, source_column, columns };
  PressureInputs(session::Workbench& bench, session::PressureBoard& board, PressureGuard guard);

 private:
  void fill();
  void typed(QTreeWidgetItem* item, int column);
  session::Workbench& bench_;
  session::PressureBoard& board_;
  PressureGuard guard_;
  bool filling_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
