#include "playback.h"

#include <algorithm>
#include <cmath>

namespace ostia::live {
namespace {

using motion::EcgSignal;
using motion::PhaseSource;

double share(double phase) {
  return phase - std::floor(phase);
}

}  // namespace

Playback::Playback(std::optional<EcgFeed> feed, double start_s)
    : feed_(std::move(feed)), follows_(feed_.has_value()), stream_s_(start_s) {
  if (feed_) feed_->seek(start_s);
}

void Playback::follow_ecg(bool on) {
  if (!feed_ || on == follows_) return;
  if (!on) loop_phase_ = phase();
  follows_ = on;
  scrubbed_.reset();
}

std::size_t Playback::advance(double seconds) {
  if (paused_) return 0;
  stream_s_ += seconds * speed_;
  loop_phase_ = share(loop_phase_ + seconds * speed_ / loop_interval_s_);
  return feed_ ? feed_->advance_to(stream_s_) : 0;
}

void Playback::pause(bool on) {
  if (!on && scrubbed_) {
    if (!follows_) loop_phase_ = *scrubbed_;
    scrubbed_.reset();
  }
  paused_ = on;
}

void Playback::set_speed(double speed) {
  speed_ = std::clamp(speed, 0.05, 8.0);
}

void Playback::set_loop_interval(double seconds) {
  loop_interval_s_ = std::clamp(seconds, 0.25, 4.0);
}

void Playback::scrub(double phase) {
  paused_ = true;
  scrubbed_ = share(phase);
}

void Playback::seek(double stream_s) {
  if (!feed_) return;
  stream_s_ = std::clamp(stream_s, 0.0, feed_->length_s());
  feed_->seek(stream_s_);
  scrubbed_.reset();
}

double Playback::phase() const {
  if (scrubbed_) return *scrubbed_;
  return follows_ ? feed_->phase().phase : loop_phase_;
}

double Playback::interval_s() const {
  const double interval = follows_ ? feed_->phase().interval_s : loop_interval_s_;
  return interval > 0.0 ? interval : 1.0;
}

StateText Playback::state() const {
  if (scrubbed_) return {"standing still at a chosen phase"};
  if (paused_) return {"paused"};
  if (!follows_) return {"in a loop, without an ECG"};
  const motion::HeartPhaseNow now = feed_->phase();
  switch (now.source) {
    case PhaseSource::waiting:
      return {"waiting for two beats", Concern::attention};
    case PhaseSource::following:
      return now.regular ? StateText{"following the ECG"}
                         : StateText{"following; the last beat was irregular", Concern::attention};
    case PhaseSource::holding:
      return {"holding: the next beat is late", Concern::attention};
    case PhaseSource::coasting:
      return {"coasting: no beat, goes on at the last rate", Concern::trouble};
  }
  return {};
}

StateText Playback::signal() const {
  if (!feed_) return {};
  if (feed_->ended()) return {"the record has ended", Concern::trouble};
  switch (feed_->signal()) {
    case EcgSignal::good:
      return {"signal good"};
    case EcgSignal::missing:
      return {"no signal: samples are missing", Concern::trouble};
    case EcgSignal::flat:
      return {"flat signal: is an electrode off?", Concern::trouble};
    case EcgSignal::clipped:
      return {"peaks are cut off: lower the gain", Concern::attention};
  }
  return {};
}

}  // namespace ostia::live
