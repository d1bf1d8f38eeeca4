#pragma once
/// \file A smooth random function of one variable.

#include "ostia/phantom/noise.h"

#include <cmath>
#include <cstdint>

namespace ostia::phantom {

/// A stationary Gaussian process with mean 0, deviation 1 and correlation exp(-d^2 / (2 L^2)): white noise on
/// a lattice, convolved with a Gaussian. `stream` tells processes apart that share a seed.
inline double smooth_process(std::uint64_t seed, std::uint64_t stream, double x, double correlation_length) {
  const double sigma = correlation_length / std::sqrt(2.0);
  const double lattice = 0.5 * sigma;
  const auto middle = static_cast<std::int64_t>(std::floor(x / lattice));
  double sum = 0.0, squares = 0.0;
  for (std::int64_t k = middle - 8; k <= middle + 9; ++k) {
    const double d = (x - static_cast<double>(k) * lattice) / sigma;
    const double weight = std::exp(-0.5 * d * d);
    sum += weight * normal(seed, (stream << 24) + static_cast<std::uint64_t>(k + (1 << 20)));
    squares += weight * weight;
  }
  return sum / std::sqrt(squares);
}

}  // namespace ostia::phantom
