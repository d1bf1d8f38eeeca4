#pragma once
/// \file Numbers for growth: the same for the same seed, as far as log and cos are.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>

namespace ostia::analysis {

/// SplitMix64 (Steele, Lea, Flood 2014).
class GrowthRandom {
 public:
  GrowthRandom(std::uint64_t seed, std::uint64_t stream) : state_(seed ^ (stream * 0xd1342543de82ef95ULL)) {
    next();
  }
  double uniform() { return (static_cast<double>(next() >> 11U) + 0.5) * 0x1p-53; }
  double between(double low, double high) { return low + (high - low) * uniform(); }
  double normal() {
    const double size = uniform(), angle = uniform();  // one after the other: the order is part of the result
    return std::sqrt(-2.0 * std::log(size)) * std::cos(2.0 * std::numbers::pi * angle);
  }
  /// Of mean 1 and standard deviation `sd` > 0 (Marsaglia and Tsang 2000).
  double gamma(double sd) {
    const double shape = 1.0 / (sd * sd), d = std::max(shape, 1.0 + 1e-9) - 1.0 / 3.0;
    const double c = 1.0 / std::sqrt(9.0 * d);
    for (;;) {
      const double x = normal(), v = (1.0 + c * x) * (1.0 + c * x) * (1.0 + c * x);
      if (v <= 0.0 || std::log(uniform()) >= 0.5 * x * x + d - d * v + d * std::log(v)) continue;
      return d * v / (d + 1.0 / 3.0);
    }
  }

 private:
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15ULL);
    z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31U);
  }
  std::uint64_t state_;
};

}  // namespace ostia::analysis
