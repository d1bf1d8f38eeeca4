#include "ostia/session/phase_clock.h"

#include <cmath>

namespace ostia::session {

double PhaseClock::phase() const {
  const double share = percent.get() / 100.0;
  return share - std::floor(share);
}

void PhaseClock::pass(double seconds) {
  if (!std::isfinite(seconds) || seconds < 0.0)
    throw InvalidInput("a cycle goes on by a time that is finite and not negative");
  if (!playing.get()) return;
  const double to = percent.get() + 100.0 * seconds * beats_a_minute.get() / 60.0;
  if (to >= 100.0 && !loop.get()) {
    percent.set(100.0);
    playing.set(false);
    return;
  }
  percent.set(to - 100.0 * std::floor(to / 100.0));
}

void PhaseClock::toggle() {
  if (!playing.get() && !loop.get() && percent.get() >= 100.0) percent.set(0.0);
  playing.set(!playing.get());
}

}  // namespace ostia::session
