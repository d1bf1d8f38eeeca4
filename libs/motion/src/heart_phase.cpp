#include "ostia/motion/heart_phase.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::motion {
namespace {

constexpr double coast_after = 1.5;  // intervals without a beat
constexpr int most_gaps = 2;         // in a row

}  // namespace

HeartPhase::HeartPhase(double latency_s) : latency_s_(latency_s) {
  if (!(latency_s >= 0.0 && latency_s <= 1.0))
    throw InvalidInput("beats cannot be told " + std::to_string(latency_s) + " s late: give 0 to 1 s");
}

void HeartPhase::beat(double time_s) {
  if (!std::isfinite(time_s)) throw InvalidInput("a beat needs a time");
  if (last_) {
    if (time_s <= *last_)
      throw InvalidInput("a beat at " + std::to_string(time_s) + " s comes after one at " +
                         std::to_string(*last_) + " s: give them in the order of time");
    const double interval = time_s - *last_;
    const auto expected = intervals_.next();
    // after a gap an interval is several, and says nothing; gap after gap are none, but a slower heart
    gaps_ = expected && interval >= 2.5 * *expected ? gaps_ + 1 : 0;
    if (gaps_ == 0 || gaps_ > most_gaps) intervals_.add(interval);
  }
  last_ = time_s;
}

HeartPhaseNow HeartPhase::at(double time_s) const {
  const auto interval = intervals_.next();
  if (!last_ || !interval) return {};
  HeartPhaseNow now;
  now.interval_s = *interval;
  now.regular = intervals_.last_was_regular();
  const double since = std::max(0.0, time_s - *last_) / *interval;
  const double untold = latency_s_ / *interval;
  if (since < 1.0 + untold) {
    now.source = PhaseSource::following;
    now.phase = since;
  } else if (since < std::max(coast_after, 1.0 + untold)) {
    now.source = PhaseSource::holding;
    now.phase = untold;
  } else {
    now.source = PhaseSource::coasting;
    now.phase = since;
  }
  now.phase -= std::floor(now.phase);
  return now;
}

}  // namespace ostia::motion
