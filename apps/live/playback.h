#pragma once
/// \file Which phase is shown now, and why.

#include "ecg_feed.h"

#include <optional>
#include <string>

namespace ostia::live {

/// How the state is to be marked.
enum class Concern { none, attention, trouble };
struct StateText {
  std::string text;
  Concern concern = Concern::none;
};

/// Follows an electrocardiogram, or loops at an even rate; stands still, or at a phase that a person chose.
class Playback {
 public:
  explicit Playback(std::optional<EcgFeed> feed, double start_s = 0.0);

  bool has_ecg() const { return feed_.has_value(); }
  const EcgFeed* feed() const { return feed_ ? &*feed_ : nullptr; }
  bool follows_ecg() const { return follows_; }
  void follow_ecg(bool on);  ///< no effect without an ECG

  /// So many seconds of the wall's clock; returns how many samples came in.
  std::size_t advance(double seconds);
  double stream_s() const { return stream_s_; }

  bool paused() const { return paused_; }
  void pause(bool on);
  double speed() const { return speed_; }
  void set_speed(double speed);  ///< 0.05 to 8
  double loop_interval_s() const { return loop_interval_s_; }
  void set_loop_interval(double seconds);  ///< 0.25 to 4
  /// Stands still there.
  void scrub(double phase);
  void seek(double stream_s);  ///< in the record

  double phase() const;  ///< in [0, 1)
  /// Of the cycle now, for velocities.
  double interval_s() const;
  StateText state() const;
  StateText signal() const;  ///< empty without an ECG

 private:
  std::optional<EcgFeed> feed_;
  bool follows_, paused_ = false;
  double speed_ = 1.0, stream_s_ = 0.0, loop_interval_s_ = 1.0, loop_phase_ = 0.0;
  std::optional<double> scrubbed_;
};

}  // namespace ostia::live
