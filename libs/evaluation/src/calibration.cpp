#include "ostia/evaluation/calibration.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::evaluation {

Calibration calibration_of(const std::vector<Forecast>& forecasts, int bins) {
  constexpr std::size_t enough = 10;  // forecasts of a bin that can be far off
  if (bins < 1) throw InvalidInput("calibration: one bin or more, not " + std::to_string(bins));
  Calibration sum;
  for (int b = 0; b < bins; ++b)
    sum.bins.push_back({static_cast<double>(b) / bins, static_cast<double>(b + 1) / bins});
  for (const Forecast& one : forecasts) {
    if (!(one.probability >= 0.0 && one.probability <= 1.0))
      throw InvalidInput("calibration: a probability lies in [0, 1], not " + std::to_string(one.probability));
    CalibrationBin& bin =
        sum.bins[static_cast<std::size_t>(std::min(static_cast<int>(one.probability * bins), bins - 1))];
    const double event = one.right ? 1.0 : 0.0;
    ++bin.count;
    bin.said += one.probability;
    bin.right += event;
    sum.right += event;
    sum.brier += (one.probability - event) * (one.probability - event);
  }
  sum.count = forecasts.size();
  if (sum.count == 0) return sum;
  const auto all = static_cast<double>(sum.count);
  for (CalibrationBin& bin : sum.bins) {
    if (bin.count == 0) continue;
    const auto here = static_cast<double>(bin.count);
    bin.said /= here;
    bin.right /= here;
    const double error = std::abs(bin.said - bin.right);
    sum.expected_error += error * here / all;
    if (bin.count >= enough) sum.largest_error = std::max(sum.largest_error, error);
  }
  sum.right /= all;
  sum.brier /= all;
  sum.brier_of_rate = sum.right * (1.0 - sum.right);
  return sum;
}

}  // namespace ostia::evaluation
