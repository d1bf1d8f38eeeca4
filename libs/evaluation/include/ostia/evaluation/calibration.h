#pragma once
/// \file Whether probabilities are frequencies: of what was given 0.7, seven in ten should be so.

#include <cstddef>
#include <vector>

namespace ostia::evaluation {

/// What was said of an event, and whether it came.
struct Forecast {
  double probability = 0.0;  ///< [0, 1]
  bool right = false;
};

/// The forecasts of one range of probabilities.
struct CalibrationBin {
  double from = 0.0, to = 0.0;  ///< [from, to), the last one closed
  std::size_t count = 0;
  double said = 0.0, right = 0.0;  ///< mean probability and share that came; 0 without forecasts
};

struct Calibration {
  std::size_t count = 0;
  double right = 0.0;                ///< share that came: the base rate
  double expected_error = 0.0;       ///< mean of |said - right| over the bins, weighted by their counts
  double largest_error = 0.0;        ///< of a bin of ten forecasts or more
  double brier = 0.0;                ///< mean of (probability - event)^2 [Brier]
  double brier_of_rate = 0.0;        ///< what always saying the base rate would have
  std::vector<CalibrationBin> bins;  ///< of equal width, all of [0, 1]
};

/// Reliability and expected calibration error [Guo]. Without forecasts all is 0. Throws InvalidInput for no
/// bin and a probability outside [0, 1].
Calibration calibration_of(const std::vector<Forecast>& forecasts, int bins = 10);

}  // namespace ostia::evaluation
