#include "frame_meter.h"

#include <algorithm>
#include <cmath>

namespace ostia::live {
namespace {

Spread spread_of(std::vector<double> seconds) {
  Spread spread;
  spread.count = seconds.size();
  if (seconds.empty()) return spread;
  std::sort(seconds.begin(), seconds.end());
  const auto at = [&](double share) {
    return 1e3 *
           seconds[static_cast<std::size_t>(std::ceil(share * static_cast<double>(seconds.size() - 1)))];
  };
  spread.p50 = at(0.5);
  spread.p95 = at(0.95);
  spread.max = at(1.0);
  return spread;
}

}  // namespace

void FrameMeter::shown(double time_s, std::size_t samples, double newest_s, double apart_s) {
  times_.push_back(time_s);
  if (!keeps_all_) {
    times_.erase(times_.begin(), std::lower_bound(times_.begin(), times_.end(), time_s - 1.0));
    return;
  }
  for (std::size_t k = 0; k < samples; ++k)
    latencies_.push_back(time_s - newest_s + static_cast<double>(k) * apart_s);
}

double FrameMeter::frames_per_second() const {
  if (times_.size() < 2 || times_.back() <= times_.front()) return 0.0;
  return static_cast<double>(times_.size() - 1) / (times_.back() - times_.front());
}

double FrameMeter::recent_frames_per_second() const {
  if (times_.empty()) return 0.0;
  const auto first = std::lower_bound(times_.begin(), times_.end(), times_.back() - 1.0);
  const auto count = times_.end() - first;
  return count < 2 ? 0.0 : static_cast<double>(count - 1) / (times_.back() - *first);
}

Spread FrameMeter::frame_ms() const {
  std::vector<double> ways;
  for (std::size_t i = 1; i < times_.size(); ++i) ways.push_back(times_[i] - times_[i - 1]);
  return spread_of(std::move(ways));
}

Spread FrameMeter::latency_ms() const {
  return spread_of(latencies_);
}

}  // namespace ostia::live
