#include "ostia/solver/waveform.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>

namespace ostia::solver {
namespace {

using Complex = std::complex<double>;

[[noreturn]] void refuse(const std::string& what) {
  throw InvalidInput("cannot use the flow's waveform: " + what);
}

/// Calls body(t0, q0, t1, q1) for each straight piece of the cycle.
template <class Body>
void for_pieces(const FlowWaveform& w, const Body& body) {
  for (std::size_t i = 0; i < w.time_s.size(); ++i) {
    const bool last = i + 1 == w.time_s.size();
    body(w.time_s[i], w.flow_ml_s[i], last ? w.time_s[0] + w.period_s : w.time_s[i + 1],
         w.flow_ml_s[last ? 0 : i + 1]);
  }
}

double mean_of(const FlowWaveform& w) {
  double sum = 0.0;
  for_pieces(w, [&](double t0, double q0, double t1, double q1) { sum += (t1 - t0) * (q0 + q1) / 2.0; });
  return sum / w.period_s;
}

struct Lobe {
  double from, to, height;  // shares of the cycle; over the baseline
};

/// Smooth bumps on a baseline.
FlowWaveform bumps(double period_s, double baseline, const std::array<Lobe, 2>& lobes) {
  FlowWaveform w;
  w.period_s = period_s;
  w.relative = true;
  constexpr int samples = 80;
  for (int i = 0; i < samples; ++i) {
    const double share = static_cast<double>(i) / samples;
    double flow = baseline;
    for (const Lobe& lobe : lobes) {
      if (share <= lobe.from || share >= lobe.to) continue;
      const double s = std::sin(std::numbers::pi * (share - lobe.from) / (lobe.to - lobe.from));
      flow += lobe.height * s * s;
    }
    w.time_s.push_back(share * period_s);
    w.flow_ml_s.push_back(flow);
  }
  const double mean = mean_of(w);
  for (double& flow : w.flow_ml_s) flow /= mean;
  return w;
}

}  // namespace

void validate(const FlowWaveform& w) {
  if (w.time_s.size() < 3 || w.time_s.size() != w.flow_ml_s.size())
    refuse("it needs three samples at least, one flow for each time");
  if (!(w.period_s > 0.0) || !std::isfinite(w.period_s)) refuse("its period must be positive, in seconds");
  for (std::size_t i = 0; i < w.time_s.size(); ++i) {
    if (!std::isfinite(w.time_s[i]) || !std::isfinite(w.flow_ml_s[i]))
      refuse("sample " + std::to_string(i + 1) + " is not finite");
    if (w.time_s[i] < 0.0 || (i > 0 && w.time_s[i] <= w.time_s[i - 1]))
      refuse("times must rise from 0 on; that of sample " + std::to_string(i + 1) + " does not");
  }
  if (w.time_s.back() >= w.time_s.front() + w.period_s)
    refuse(
        "its last time must lie within one period of the first; the last sample of a cycle is not given "
        "again");
  if (!(mean_of(w) > 0.0)) refuse("its mean flow must be positive (into the vessel)");
}

double mean_flow(const FlowWaveform& w) {
  validate(w);
  return mean_of(w);
}

FlowWaveform builtin_waveform(std::string_view name) {
  constexpr double period_s = 0.8, baseline = 0.25;
  if (name == "coronary-left") return bumps(period_s, baseline, {{{0.0, 0.36, 0.375}, {0.36, 1.0, 1.0}}});
  if (name == "coronary-right") return bumps(period_s, baseline, {{{0.0, 0.36, 0.8}, {0.36, 1.0, 1.01}}});
  throw InvalidInput("there is no waveform \"" + std::string(name) +
                     "\"; there are coronary-left and coronary-right, or a table of time_s,flow_ml_s");
}

double FlowHarmonics::angular_frequency(std::size_t k) const {
  return 2.0 * std::numbers::pi * static_cast<double>(k) / period_s;
}

double FlowHarmonics::flow_ml_s(double time_s) const {
  double flow = mean_ml_s;
  for (std::size_t k = 1; k <= amplitude_ml_s.size(); ++k)
    flow += (amplitude_ml_s[k - 1] * std::polar(1.0, angular_frequency(k) * time_s)).real();
  return flow;
}

double FlowHarmonics::largest_flow_ml_s() const {
  double largest = 0.0;
  for (int i = 0; i < 1000; ++i) largest = std::max(largest, std::abs(flow_ml_s(period_s * i / 1000.0)));
  return largest;
}

FlowHarmonics harmonics_of(const FlowWaveform& w, int count) {
  validate(w);
  if (count < 1 || count > 60) refuse("the number of harmonics must be in [1, 60]");
  FlowHarmonics out;
  out.period_s = w.period_s;
  out.mean_ml_s = mean_of(w);
  for (int k = 1; k <= count; ++k) {
    const double omega = out.angular_frequency(static_cast<std::size_t>(k));
    Complex sum = 0.0;
    for_pieces(w, [&](double t0, double q0, double t1, double q1) {
      const Complex a = std::polar(1.0, -omega * t0), b = std::polar(1.0, -omega * t1);
      const double slope = (q1 - q0) / (t1 - t0);
      // Antiderivative of q exp(-i omega t), q of constant slope.
      sum += (q1 * b - q0 * a) * Complex(0.0, 1.0 / omega) + slope * (b - a) / (omega * omega);
    });
    out.amplitude_ml_s.push_back(2.0 * sum / w.period_s);
  }
  return out;
}

}  // namespace ostia::solver
