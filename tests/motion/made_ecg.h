#pragma once
/// \file Electrocardiograms of known beats: each a sum of five Gaussian waves (P, Q, R, S, T).

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <random>
#include <vector>

namespace ostia::motion {

struct MadeEcg {
  double rate = 360.0, r_mv = 1.0, t_mv = 0.3, noise_mv = 0.0, wander_mv = 0.0, hum_mv = 0.0;
  std::vector<double> r_times;  // s

  /// Beats at intervals that `interval(k)` gives.
  template <class Interval>
  void beats(std::size_t count, const Interval& interval) {
    double t = 0.5;
    for (std::size_t k = 0; k < count; ++k) {
      r_times.push_back(t);
      t += interval(k);
    }
  }
  std::vector<double> lead() const {
    struct Wave {
      double at, width, height;
    };
    const double p = 0.1 * r_mv / std::abs(r_mv);
    const Wave waves[] = {{-0.16, 0.025, p},
                          {-0.03, 0.010, -0.12 * r_mv},
                          {0.0, 0.011, r_mv},
                          {0.03, 0.011, -0.2 * r_mv},
                          {0.26, 0.045, t_mv}};
    const auto samples = static_cast<std::size_t>((r_times.back() + 0.6) * rate);
    std::vector<double> values(samples);
    std::mt19937 random(7);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (std::size_t i = 0; i < samples; ++i) {
      const double t = static_cast<double>(i) / rate;
      values[i] = wander_mv * std::sin(2.0 * std::numbers::pi * 0.25 * t) +
                  hum_mv * std::sin(2.0 * std::numbers::pi * 50.0 * t) + noise_mv * noise(random);
    }
    for (const double r : r_times)
      for (const Wave& wave : waves) {
        const auto from = static_cast<std::ptrdiff_t>((r + wave.at - 5.0 * wave.width) * rate);
        const auto to = static_cast<std::ptrdiff_t>((r + wave.at + 5.0 * wave.width) * rate);
        for (auto i = std::max<std::ptrdiff_t>(0, from); i <= to && i < static_cast<std::ptrdiff_t>(samples);
             ++i) {
          const double x = (static_cast<double>(i) / rate - r - wave.at) / wave.width;
          values[static_cast<std::size_t>(i)] += wave.height * std::exp(-0.5 * x * x);
        }
      }
    return values;
  }
};

}  // namespace ostia::motion
