#pragma once
/// \file A flow that repeats: one cycle, and its harmonics.

#include <complex>
#include <string_view>
#include <vector>

namespace ostia::solver {

/// Flow over one cycle, straight between the samples, the last one joined to the first a period later.
struct FlowWaveform {
  std::vector<double> time_s;     ///< rising, the first at 0 or later, the last before `period_s`
  std::vector<double> flow_ml_s;  ///< into the vessel
  double period_s = 0.0;
  bool relative = false;  ///< the values are flow over mean flow
};

/// Throws InvalidInput: fewer than three samples, times that do not rise or do not fit the period, values
/// that are not finite, a mean that is not positive.
void validate(const FlowWaveform& waveform);
/// ml/s.
double mean_flow(const FlowWaveform& waveform);

/// Flow over mean flow of a heart at rest, 0.8 s, one low wave in systole and a higher one in diastole:
/// `coronary-left` (diastolic peak twice the systolic), `coronary-right` (1.2 times). A model curve, no
/// measurement. Throws InvalidInput that lists the names for any other.
FlowWaveform builtin_waveform(std::string_view name);

/// flow(t) = mean + Re sum amplitude[k - 1] exp(i k omega t), ml/s.
struct FlowHarmonics {
  double mean_ml_s = 0.0;
  std::vector<std::complex<double>> amplitude_ml_s;
  double period_s = 0.0;
  double angular_frequency(std::size_t k) const;  ///< of the k-th, from 1
  double flow_ml_s(double time_s) const;
  double largest_flow_ml_s() const;  ///< over a cycle, to a thousandth of it
};

/// Harmonics of the straight pieces, exact. Throws as validate does, and for a count outside [1, 60].
FlowHarmonics harmonics_of(const FlowWaveform& waveform, int count);

}  // namespace ostia::solver
