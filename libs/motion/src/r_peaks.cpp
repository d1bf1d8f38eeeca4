#include "ostia/motion/r_peaks.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::motion {
namespace {

constexpr double short_half_s = 0.008, long_half_s = 0.045;  // of the averages
constexpr double kept_s = 4.0;
constexpr double learning_s = 2.0;
constexpr double refractory_s = 0.2, t_wave_s = 0.36;  // Pan and Tompkins 1985
constexpr double overdue = 1.66;                       // intervals
constexpr double slowest_interval_s = 2.0;             // assumed until there is one
constexpr double ends_below = 0.5;                     // of a bump's height
constexpr double beat_share = 0.3;                     // of the way from noise to beats
constexpr double memory = 0.125;                       // of the running means
constexpr double refine_s = 0.025;
constexpr double doubt_s = 0.045;  // a greater wave of the same beat may follow a smaller one: Q, then R

}  // namespace

RPeakDetector::RPeakDetector(double samples_per_second) : rate_(samples_per_second) {
  if (!(rate_ >= 100.0 && rate_ <= 10000.0))
    throw InvalidInput("an electrocardiogram of " + std::to_string(samples_per_second) +
                       " samples a second cannot be followed: 100 to 10000 can");
  short_ = samples(short_half_s);
  long_ = samples(long_half_s);
  raw_.assign(samples(kept_s), 0.0);
}

std::size_t RPeakDetector::samples(double seconds) const {
  return std::max<std::size_t>(1, static_cast<std::size_t>(std::lround(seconds * rate_)));
}

double RPeakDetector::latency_s() const {
  return (static_cast<double>(long_) + 2.0) / rate_ + doubt_s;  // the filter's delay besides
}

double RPeakDetector::since_last_beat_s(std::size_t sample) const {
  return last_beat_ ? (static_cast<double>(sample) - static_cast<double>(*last_beat_)) / rate_ : 1e9;
}

/// The band of the sample `long_` before the newest.
double RPeakDetector::filtered() {
  const std::size_t newest = count_ - 1, width = 2 * long_ + 1;
  long_sum_ += raw(newest);
  if (count_ > width) long_sum_ -= raw(newest - width);
  if (newest < long_ - short_) return 0.0;
  const std::size_t inner = newest - (long_ - short_), inner_width = 2 * short_ + 1;
  short_sum_ += raw(inner);
  if (inner >= inner_width) short_sum_ -= raw(inner - inner_width);
  if (count_ < width) return 0.0;
  return short_sum_ / static_cast<double>(inner_width) - long_sum_ / static_cast<double>(width);
}

/// A run of equal values at the end of the range, far from its middle.
bool RPeakDetector::cut_off(double value) const {
  const std::size_t n = std::min(count_, raw_.size());
  const auto [low, high] = std::minmax_element(raw_.begin(), raw_.begin() + static_cast<std::ptrdiff_t>(n));
  double mean = 0.0;
  for (std::size_t i = 0; i < n; ++i) mean += raw_[i] / static_cast<double>(n);
  return (value >= *high || value <= *low) && std::abs(value - mean) > 0.3 * (*high - *low);
}

void RPeakDetector::watch_signal(double value, bool missing) {
  missing_ = missing ? missing_ + 1 : 0;
  equal_ = count_ > 1 && value == raw(count_ - 2) ? equal_ + 1 : 0;
  const std::size_t run = std::max<std::size_t>(5, samples(0.025));
  if (!missing && equal_ == run && cut_off(value)) clipped_at_ = count_;
}

EcgSignal RPeakDetector::signal() const {
  if (missing_ >= samples(0.25)) return EcgSignal::missing;
  if (equal_ >= samples(0.5)) return EcgSignal::flat;
  if (clipped_at_ && count_ - *clipped_at_ < samples(3.0)) return EcgSignal::clipped;
  return EcgSignal::good;
}

void RPeakDetector::learn(double height) {
  beat_height_ = std::max(beat_height_, 0.7 * height);
  if (height > 0.0) ++learnt_;
  noise_height_ += height / (learning_s * rate_);
  knows_sizes_ = learnt_ >= samples(learning_s);
}

/// The sizes were those of something else, such as the lead being plugged in, when a good signal has no beats
/// of that size for long.
void RPeakDetector::forget_when_in_vain() {
  if (signal() == EcgSignal::good) ++waited_;
  if (waited_ < samples(kept_s)) return;
  knows_sizes_ = false;
  learnt_ = waited_ = 0;
  beat_height_ = noise_height_ = counted_height_ = 0.0;
  bump_ = second_ = {};
  pending_.reset();
}

void RPeakDetector::learn_from(const RPeakDetector& other) {
  beat_height_ = other.beat_height_;
  noise_height_ = other.noise_height_;
  interval_s_ = other.interval_s_;
  knows_sizes_ = other.knows_sizes_;
}

/// Falls when beats stay away, down to what noise allows.
double RPeakDetector::threshold(double since_s) const {
  const double usual = noise_height_ + beat_share * (beat_height_ - noise_height_);
  if (!last_beat_) return usual;
  const double late = since_s - overdue * interval_s_.value_or(slowest_interval_s);
  if (late <= 0.0) return usual;
  return std::max({usual * std::exp2(-late), 0.5 * beat_share * beat_height_, 2.5 * noise_height_});
}

std::size_t RPeakDetector::refined(const Bump& bump) const {
  const std::size_t reach = samples(refine_s), oldest = count_ > raw_.size() ? count_ - raw_.size() : 0;
  const std::size_t from = std::max(oldest, bump.sample > reach ? bump.sample - reach : 0);
  const std::size_t to = std::min(count_ - 1, bump.sample + reach);
  const double sign = bump.upward ? 1.0 : -1.0;
  std::size_t best = from, last = from;  // of equal ones the middle
  for (std::size_t i = from; i <= to; ++i) {
    if (sign * raw(i) > sign * raw(best)) best = last = i;
    if (raw(i) == raw(best) && i == last + 1) last = i;
  }
  return (best + last) / 2;
}

RPeak RPeakDetector::told(const Bump& bump) {
  const std::size_t peak = refined(bump);
  const double interval = since_last_beat_s(peak);
  gaps_ = interval >= 2.5 * interval_s_.value_or(slowest_interval_s) ? gaps_ + 1 : 0;
  if (last_beat_ && (gaps_ == 0 || gaps_ > 2)) {  // gap after gap are a slower heart
    const double mean = interval_s_.value_or(interval);
    interval_s_ = mean + memory * (interval - mean);
  }
  last_beat_ = peak;
  waited_ = 0;
  second_ = {};
  return {peak, count_ - 1};
}

std::optional<RPeak> RPeakDetector::told_pending() {
  const Bump bump = *pending_;
  pending_.reset();
  counted_height_ = std::min(bump.height, 2.0 * beat_height_);
  beat_height_ += memory * (counted_height_ - beat_height_);
  return told(bump);
}

void RPeakDetector::judge(const Bump& bump) {
  const double since = since_last_beat_s(bump.sample);
  if (since < refractory_s) {  // the same beat, whose first wave may be its smallest
    const double height = std::min(bump.height, 2.0 * beat_height_);
    if (height > counted_height_) {
      beat_height_ += memory * (height - counted_height_);
      counted_height_ = height;
    }
    return;
  }
  const bool t_wave = since < t_wave_s && bump.height < 0.5 * beat_height_;
  if (!t_wave && bump.height >= threshold(since)) {
    if (!pending_ || bump.height > pending_->height) pending_ = bump;
    return;
  }
  noise_height_ += memory * (bump.height - noise_height_);
  if (!t_wave && bump.height > second_.height) second_ = bump;
}

std::optional<RPeak> RPeakDetector::search_back() {
  const double since = since_last_beat_s(count_ - 1 - long_);
  if (!last_beat_ || !interval_s_ || since < overdue * *interval_s_) return std::nullopt;
  const double half = 0.5 * (noise_height_ + beat_share * (beat_height_ - noise_height_));
  if (second_.height <= half || second_.height < 2.0 * noise_height_) return std::nullopt;
  if (count_ - second_.sample + samples(refine_s) >= raw_.size()) return std::nullopt;  // too long ago
  beat_height_ += 2.0 * memory * (second_.height - beat_height_);
  return told(second_);
}

std::optional<RPeak> RPeakDetector::push(double value) {
  const bool missing = !std::isfinite(value);
  if (missing) value = last_value_;
  last_value_ = value;
  ++count_;
  raw(count_ - 1) = value;
  watch_signal(value, missing);
  const double band = filtered(), height = std::abs(band);
  if (!knows_sizes_) {
    learn(height);
    return std::nullopt;
  }
  forget_when_in_vain();
  if (height > bump_.height) bump_ = {count_ - 1 - long_, height, band > 0.0};
  if (height < ends_below * bump_.height) {
    judge(bump_);
    bump_ = {count_ - 1 - long_, height, band > 0.0};
  }
  const bool old = pending_ && count_ - 1 - long_ >= pending_->sample + samples(doubt_s);
  if (old && bump_.height <= pending_->height) return told_pending();
  return search_back();
}

std::vector<std::size_t> r_peaks(const std::vector<double>& lead, double samples_per_second) {
  RPeakDetector first(samples_per_second);
  for (std::size_t i = 0; i < std::min(lead.size(), first.samples(10.0)); ++i) first.push(lead[i]);
  RPeakDetector detector(samples_per_second);
  detector.learn_from(first);
  std::vector<std::size_t> peaks;
  const auto take = [&](std::optional<RPeak> peak) {
    if (peak && peak->sample < lead.size()) peaks.push_back(peak->sample);
  };
  for (const double value : lead) take(detector.push(value));
  const double last = detector.last_value_;  // what is still in the filter
  for (std::size_t i = 0; i < detector.samples(0.15); ++i) take(detector.push(last));
  return peaks;
}

std::size_t clearest_lead(const geometry::EcgRecord& record) {
  if (record.leads.empty()) throw InvalidInput("an electrocardiogram without leads has no heartbeats");
  std::size_t best = 0;
  double clearest = -1.0;
  for (std::size_t s = 0; s < record.leads.size(); ++s) {
    RPeakDetector detector(record.samples_per_second);
    const auto& values = record.leads[s].values;
    for (std::size_t i = 0; i < std::min(values.size(), detector.samples(30.0)); ++i)
      detector.push(values[i]);
    const double clear = detector.noise_height_ > 0.0 ? detector.beat_height_ / detector.noise_height_ : 0.0;
    if (clear > clearest) {
      clearest = clear;
      best = s;
    }
  }
  return best;
}

}  // namespace ostia::motion
