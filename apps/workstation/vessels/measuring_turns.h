#pragma once
/// \file Vessels that are measured again after an edit, one a turn of the event loop.

#include "ostia/session/workbench.h"

#include <QScopedValueRollback>
#include <cstdint>
#include <exception>
#include <vector>

namespace ostia::workstation {

/// For lists that show narrowings of all vessels: where an edit moved a trunk's wall, its branches are to be
/// measured again, too, and the window answers between them.
class MeasuringTurns {
 public:
  explicit MeasuringTurns(session::Workbench& bench) : bench_(bench) {}
  /// With all vessels that were measured before; others are for a thread (ProfileWork).
  void begin() {
    left_.clear();
    if (!bench_.model()) return;
    for (const auto& vessel : bench_.model()->vessels)
      if (!bench_.profile_work(vessel->vessel)) left_.push_back(vessel->vessel);
  }
  /// Measures what has moved of one of them; false where none is left.
  bool next() {
    if (left_.empty()) return false;
    const QScopedValueRollback<bool> now(measuring_, true);
    const std::int32_t vessel = left_.back();
    left_.pop_back();
    try {
      bench_.stenoses(vessel);
    } catch (const std::exception&) {  // told where it is looked at
    }
    return true;
  }
  bool measuring() const { return measuring_; }  ///< now: what changes meanwhile is asked for

 private:
  session::Workbench& bench_;
  std::vector<std::int32_t> left_;
  bool measuring_ = false;
};

}  // namespace ostia::workstation
