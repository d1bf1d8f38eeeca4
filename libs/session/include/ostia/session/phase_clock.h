#pragma once
/// \file Where in the heart's cycle a view is, and how it goes on by itself.

#include "ostia/session/property.h"

namespace ostia::session {

/// The phase that is shown, as percent of the cycle, played by whoever tells it how much time has passed.
class PhaseClock {
 public:
  Property<double> percent{0.0, Range<double>{0.0, 100.0, 0.0}};  ///< 100 is the next beat's 0
  Property<bool> playing{false};
  Property<bool> loop{true};  ///< else it stops at the end of the cycle
  Property<double> beats_a_minute{60.0, Range<double>{5.0, 200.0, 5.0}};
  /// The phase, share of the cycle, [0, 1).
  double phase() const;
  /// Goes on while it is playing. Throws InvalidInput for time that is not finite or negative.
  void pass(double seconds);
  /// Plays from where it is, from the beginning where it stands at the end; or pauses.
  void toggle();
};

}  // namespace ostia::session
