#pragma once
/// \file One cursor in two scans of one patient.

#include "ostia/session/comparison.h"
#include "ostia/session/workbench.h"

#include <map>
#include <memory>
#include <vector>

namespace ostia::workstation {

/// Which of the scans show the place of the cursor.
enum class Reached { both, now_alone, before_alone };

/// Keeps two workbenches at the same place of the patient, whichever of them is moved: vessel, abscissa and
/// place by the map of a comparison, and the way from which the vessel is looked at. How images are shown
/// (grey levels, slab, lines) is the same in both. Goes before them.
class OneCursor {
 public:
  OneCursor(session::Workbench& now, session::Workbench& before);
  /// The comparison whose cases are on the two; null: each goes its own way.
  void set(std::shared_ptr<const session::Comparison> made);
  session::Property<Reached> reached{Reached::both};
  /// Angle about the former axis, at the cursor, of what is at angle 0 about the present one.
  session::Property<double> turn_deg{0.0};

 private:
  void follow_now();
  void follow_before();
  double turn_of(const analysis::VesselMatch& match, const analysis::MatchedPlace& place) const;
  /// The mean along the vessel, so that a CPR does not turn as the cursor goes along it.
  double mean_turn(const analysis::VesselMatch& match);
  template <class T>
  void share(session::Property<T>& now, session::Property<T>& before);
  session::Workbench &now_, &before_;
  std::shared_ptr<const session::Comparison> made_;
  std::map<std::int32_t, double> mean_turns_;  // by the present vessel
  bool following_ = false;
  std::vector<session::Subscription> own_;
};

}  // namespace ostia::workstation
