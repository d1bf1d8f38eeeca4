#pragma once
/// \file R peaks in a running electrocardiogram. See docs/methods/ecg.md.

#include "ostia/geometry/ecg_record.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace ostia::motion {

/// What is wrong with the last second of a lead.
enum class EcgSignal {
  good,
  missing,  ///< no samples for a quarter of a second
  flat,     ///< the same value for half a second: an electrode is off
  clipped,  ///< peaks are cut off flat: beats are found, their peaks are the middle of what is cut
};

struct RPeak {
  std::size_t sample = 0;   ///< of the peak
  std::size_t told_at = 0;  ///< sample after which it was known
};

/// Takes a lead sample by sample, and tells each R peak about 90 ms after it. The signal less its slow part
/// (difference of two centred moving averages, of 16 and 90 ms: linear phase) is compared with a threshold
/// that follows the sizes of beats and of what is between them (after Pan and Tompkins 1985); beats missed
/// for 1.66 intervals are looked for again with half of it. Missing samples (NaN) are bridged by the last
/// value. Needs two seconds to learn the sizes (see `r_peaks` for whole records), and learns anew where four
/// seconds of good signal have no beat.
class RPeakDetector {
 public:
  /// Throws InvalidInput outside of 100 to 10000 samples a second.
  explicit RPeakDetector(double samples_per_second);
  std::optional<RPeak> push(double value);
  EcgSignal signal() const;
  /// The longest that a clear beat is told after its peak, in seconds.
  double latency_s() const;

 private:
  struct Bump {  // a local extreme of the filtered signal
    std::size_t sample = 0;
    double height = 0.0;
    bool upward = true;
  };
  friend std::vector<std::size_t> r_peaks(const std::vector<double>&, double);
  friend std::size_t clearest_lead(const geometry::EcgRecord&);
  void learn_from(const RPeakDetector& other);
  double& raw(std::size_t sample) { return raw_[sample % raw_.size()]; }
  double raw(std::size_t sample) const { return raw_[sample % raw_.size()]; }
  double filtered();
  void watch_signal(double value, bool missing);
  bool cut_off(double value) const;
  void learn(double height);
  void forget_when_in_vain();
  double threshold(double since_s) const;
  void judge(const Bump& bump);
  std::optional<RPeak> told_pending();
  std::optional<RPeak> search_back();
  RPeak told(const Bump& bump);
  std::size_t refined(const Bump& bump) const;
  std::size_t samples(double seconds) const;
  double since_last_beat_s(std::size_t sample) const;

  double rate_;
  std::size_t short_, long_;  // half widths of the averages, samples
  std::vector<double> raw_;   // ring of the last seconds
  std::size_t count_ = 0;
  double short_sum_ = 0.0, long_sum_ = 0.0, last_value_ = 0.0;
  double beat_height_ = 0.0, noise_height_ = 0.0;  // means of the last
  double counted_height_ = 0.0;                    // what the last beat has put into its mean
  bool knows_sizes_ = false;
  std::size_t learnt_ = 0, waited_ = 0;  // samples: learned from; good ones since the last beat
  int gaps_ = 0;                         // intervals in a row that were too long
  std::optional<double> interval_s_;     // mean of the last
  Bump bump_, second_;                   // now; the greatest since the last beat that was no beat
  std::optional<Bump> pending_;          // the greatest wave of a beat so far
  std::optional<std::size_t> last_beat_;
  std::size_t equal_ = 0, missing_ = 0;  // samples in a row
  std::optional<std::size_t> clipped_at_;
};

/// All R peaks of a lead: sizes are learned from its first ten seconds, so that none is missed at the start.
/// Throws as RPeakDetector does.
std::vector<std::size_t> r_peaks(const std::vector<double>& lead, double samples_per_second);

/// The lead whose beats stand out most (height of peaks over the deviation between them, in its first 30
/// seconds). Throws InvalidInput where there are no leads.
std::size_t clearest_lead(const geometry::EcgRecord& record);

}  // namespace ostia::motion
