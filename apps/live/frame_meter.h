#pragma once
/// \file How fast pictures come, and how old the samples are that they show.

#include <cstddef>
#include <vector>

namespace ostia::live {

struct Spread {
  double p50 = 0.0, p95 = 0.0, max = 0.0;
  std::size_t count = 0;
};

class FrameMeter {
 public:
  /// All pictures and ages are kept, or else the pictures of the last second alone.
  explicit FrameMeter(bool keeps_all = true) : keeps_all_(keeps_all) {}
  /// A picture was on the screen at this time, seconds of any clock. `newest_s`: when the newest of the
  /// samples that came in for it was due; the others came one each `apart_s` before.
  void shown(double time_s, std::size_t samples = 0, double newest_s = 0.0, double apart_s = 0.0);
  std::size_t frames() const { return times_.size(); }
  double frames_per_second() const;         ///< over all that are kept
  double recent_frames_per_second() const;  ///< over the last second
  Spread frame_ms() const;
  Spread latency_ms() const;  ///< from when a sample was due to the picture

 private:
  bool keeps_all_;
  std::vector<double> times_, latencies_;
};

}  // namespace ostia::live
