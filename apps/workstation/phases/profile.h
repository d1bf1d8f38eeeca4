#pragma once
/// \file The dock with the selected vessel's lumen over the cycle.

#include "phases/map.h"

#include <QDockWidget>
#include <QTimer>
#include <functional>
#include <memory>
#include <vector>

namespace ostia::workstation {

struct Desk;

/// Outlines are taken in the background while it is open; what the motion makes of them comes at once.
class PhaseProfile final : public QDockWidget {
  Q_OBJECT
 public:
  /// `beating`: of the case as it is; null where there is none.
  using Source = std::function<std::shared_ptr<const session::Beating>()>;
  PhaseProfile(Desk& desk, session::PhaseClock& clock, Source beating);
  void refresh();  ///< another motion, or none

 private:
  void measure();
  Desk& desk_;
  Source beating_;
  PhaseMap* map_;
  QTimer rest_;  // an edit goes on: not for each of its steps
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
