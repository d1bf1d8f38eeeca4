#pragma once
/// \file A recorded lead as if it came in now, sample by sample.

#include "ostia/motion/heart_phase.h"
#include "ostia/motion/r_peaks.h"

#include <cstddef>
#include <vector>

namespace ostia::live {

/// Knows at each time only what a live stream would have told by then. Times are seconds of the record.
class EcgFeed {
 public:
  /// Throws InvalidInput as RPeakDetector does.
  EcgFeed(std::vector<double> values, double samples_per_second);

  /// Takes in all samples due by then; returns how many. After the record's end they are missing ones, as on
  /// a cable that was pulled.
  std::size_t advance_to(double time_s);
  /// Starts anew from there, with what the half minute before tells.
  void seek(double time_s);

  double samples_per_second() const { return rate_; }
  double time_s() const;  ///< of the newest sample
  double length_s() const { return static_cast<double>(values_.size()) / rate_; }
  bool ended() const { return count_ >= values_.size(); }
  motion::HeartPhaseNow phase() const;
  motion::EcgSignal signal() const;
  /// R peaks told so far since the start or `seek`, s.
  const std::vector<double>& peaks() const { return peaks_; }
  /// A sample that has come in; NaN where missing.
  double value(std::size_t sample) const;
  std::size_t samples() const { return count_; }  ///< the first that has not come in yet

 private:
  void take();
  std::vector<double> values_;
  double rate_;
  std::size_t first_ = 0, count_ = 0;  // the detector's zero; the next sample
  motion::RPeakDetector detector_;
  motion::HeartPhase heart_;
  std::vector<double> peaks_;
};

struct LinePoint {
  double time_s = 0.0, value = 0.0;
};
/// The samples that have come in, from `first` on, as lines to be drawn `column_s` seconds to a column: where
/// more than two fall on one, its least and its greatest alone, in their order. A new line after samples that
/// are missing. Throws InvalidInput for columns without width.
std::vector<std::vector<LinePoint>> lines_of(const EcgFeed& feed, std::size_t first, double column_s);

}  // namespace ostia::live
