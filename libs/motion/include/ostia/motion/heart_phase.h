#pragma once
/// \file Where in its cycle the heart is now, from the R peaks so far. See docs/methods/ecg.md.

#include <cstddef>
#include <optional>
#include <vector>

namespace ostia::motion {

/// The next RR interval from the last ones: an autoregressive model of order 8 about their mean, fitted as
/// they come (recursive least squares, older intervals count less), so that the breath's rhythm is followed.
/// Intervals that are off by more than 12 % of the median (an ectopic beat, a beat missed) neither change
/// the model nor enter it; three in a row are a new rate.
class RrPredictor {
 public:
  RrPredictor();
  /// Throws InvalidInput unless positive and finite.
  void add(double interval_s);
  /// Nothing before the first interval. At most 12 % off the median of the last.
  std::optional<double> next() const;
  bool last_was_regular() const { return strange_in_a_row_ == 0; }

 private:
  static constexpr std::size_t order = 8, kept = 16;
  double median() const;
  double mean() const;
  double guess() const;
  void fit(double interval_s);
  std::vector<double> last_;     // newest last
  std::vector<double> strange_;  // intervals that did not fit, in a row
  std::vector<double> weights_, covariance_;
  int strange_in_a_row_ = 0;
};

enum class PhaseSource {
  waiting,    ///< fewer than two beats so far
  following,  ///< between two beats
  holding,    ///< the next beat is overdue: the heart waits, and so does the phase
  coasting,   ///< no beat for one and a half intervals: the cycle goes on as it went
};

struct HeartPhaseNow {
  double phase = 0.0;  ///< share of the cycle since the R peak, in [0, 1)
  PhaseSource source = PhaseSource::waiting;
  double interval_s = 0.0;  ///< the interval that is expected; 0 while waiting
  bool regular = true;      ///< the last interval was like those before
};

/// Phase from beats that are told some time after their R peak.
class HeartPhase {
 public:
  /// `latency_s`: how late beats are told; in [0, 1]. Throws InvalidInput.
  explicit HeartPhase(double latency_s);
  /// An R peak, in seconds; later than the one before, else InvalidInput.
  void beat(double time_s);
  /// While a beat may have come that is not told yet, the phase runs on as if it had come when expected.
  /// Then it holds where it will be when the beat is told, so that nothing jumps. `time_s` is not before the
  /// last beat.
  HeartPhaseNow at(double time_s) const;

 private:
  double latency_s_;
  std::optional<double> last_;
  int gaps_ = 0;  ///< in a row
  RrPredictor intervals_;
};

}  // namespace ostia::motion
