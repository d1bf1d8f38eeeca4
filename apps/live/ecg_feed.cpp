#include "ecg_feed.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace ostia::live {
namespace {

constexpr double known_before_s = 30.0;

}  // namespace

EcgFeed::EcgFeed(std::vector<double> values, double samples_per_second)
    : values_(std::move(values)),
      rate_(samples_per_second),
      detector_(samples_per_second),
      heart_(detector_.latency_s()) {}

double EcgFeed::time_s() const {
  return count_ == 0 ? 0.0 : static_cast<double>(count_ - 1) / rate_;
}

double EcgFeed::value(std::size_t sample) const {
  return sample < values_.size() ? values_[sample] : std::numeric_limits<double>::quiet_NaN();
}

void EcgFeed::take() {
  if (const auto peak = detector_.push(value(count_))) {
    const double at = static_cast<double>(first_ + peak->sample) / rate_;
    if (peaks_.empty() || at > peaks_.back()) {
      heart_.beat(at);
      peaks_.push_back(at);
    }
  }
  ++count_;
}

std::size_t EcgFeed::advance_to(double time_s) {
  const std::size_t before = count_;
  while (static_cast<double>(count_) / rate_ <= time_s) take();
  return count_ - before;
}

void EcgFeed::seek(double time_s) {
  const double from = std::max(0.0, time_s - known_before_s);
  first_ = count_ = static_cast<std::size_t>(std::ceil(from * rate_));
  detector_ = motion::RPeakDetector(rate_);
  heart_ = motion::HeartPhase(detector_.latency_s());
  peaks_.clear();
  advance_to(time_s);
}

motion::HeartPhaseNow EcgFeed::phase() const {
  return heart_.at(time_s());
}

motion::EcgSignal EcgFeed::signal() const {
  return detector_.signal();
}

}  // namespace ostia::live
