#include "ecg_feed.h"

#include "ostia/core/error.h"

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

std::vector<std::vector<LinePoint>> lines_of(const EcgFeed& feed, std::size_t first, double column_s) {
  if (!(column_s > 0.0)) throw InvalidInput("a column of the strip has no width");
  std::vector<std::vector<LinePoint>> lines(1);
  // Columns are counted in the record's time, so that the picture does not shimmer as it moves.
  double column = -1.0;
  LinePoint least, most;
  const auto put = [&] {
    if (column < 0.0) return;
    const bool least_first = least.time_s <= most.time_s;
    lines.back().push_back(least_first ? least : most);
    if (least.time_s != most.time_s) lines.back().push_back(least_first ? most : least);
    column = -1.0;
  };
  for (std::size_t i = first; i < feed.samples(); ++i) {
    const LinePoint point{static_cast<double>(i) / feed.samples_per_second(), feed.value(i)};
    if (std::isnan(point.value)) {
      put();
      if (!lines.back().empty()) lines.emplace_back();
      continue;
    }
    if (const double now = std::floor(point.time_s / column_s); now != column) {
      put();
      column = now;
      least = most = point;
    }
    if (point.value < least.value) least = point;
    if (point.value > most.value) most = point;
  }
  put();
  if (lines.back().empty()) lines.pop_back();
  return lines;
}

}  // namespace ostia::live
