#pragma once
/// \file The places of a found tree that the program is not sure of, in the window: a list, and commands that
/// walk through them.

#include "ostia/session/doubts.h"
#include "ostia/session/workbench.h"

#include <QTimer>
#include <QTreeWidget>
#include <optional>
#include <vector>

namespace ostia::workstation {

class CommandTable;
struct Desk;

/// One row a place, the least sure first; a row that is chosen brings all views there. What is on a checked
/// vessel, or where the axis was changed, goes out.
class DoubtList final : public QTreeWidget {
  Q_OBJECT
 public:
  explicit DoubtList(session::Workbench& bench, QWidget* parent = nullptr);

  /// To the next place in the order of doubt, or the one before (`by` -1); nothing where there is none.
  std::optional<session::DoubtfulPlace> walk(int by);
  const std::vector<session::DoubtfulPlace>& places();  ///< the least sure first
  bool knows() const { return !certainty_.empty(); }    ///< the case has probabilities

 signals:
  void known(bool probabilities);  ///< another case: whether it has them

 private:
  void read_case();
  void fill();
  void go_to(int row);
  session::Workbench& bench_;
  std::vector<coronary::VesselCertainty> certainty_;
  std::vector<session::DoubtfulPlace> places_;
  int last_ = -1;  // the row that was walked to last, or the one before where it went
  bool filling_ = false;
  QTimer soon_;
  std::vector<session::Subscription> own_;
};

void add_doubt_commands(CommandTable& table, Desk& desk, DoubtList& doubts);

}  // namespace ostia::workstation
