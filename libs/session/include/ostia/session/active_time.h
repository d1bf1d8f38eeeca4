#pragma once
/// \file How long a person has been at work.

#include <functional>

namespace ostia::session {

/// A clock that runs while somebody does something and stops when nothing was done for a while. Starts
/// paused.
class ActiveTime {
 public:
  using Clock = std::function<double()>;  ///< seconds, never running backwards
  static constexpr double usual_idle_s = 60.0;
  /// Throws InvalidInput for an idle time that is not positive.
  explicit ActiveTime(double idle_s = usual_idle_s, Clock clock = {});
  void start();  ///< counts from now on; counts as a touch
  void pause();
  void reset();  ///< to zero; runs on where it ran
  bool running() const { return running_; }
  /// The person did something. A longer silence before it is not counted beyond its first `idle_s`.
  void touch();
  double seconds() const;
  bool idle() const;  ///< running, but nothing was done for `idle_s`

 private:
  double now() const;
  double open_s() const;
  double idle_s_;
  Clock clock_;
  bool running_ = false;
  double counted_s_ = 0.0, last_s_ = 0.0;
};

}  // namespace ostia::session
