#pragma once
/// \file Weights of the uniform cubic B-spline along an axis.

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace ostia::registration {

struct SplineWeights {
  std::int64_t first = 0;  // of the four nodes
  std::array<double, 4> value{}, slope{};
};

/// At `index` in units of nodes, clamped to [1, count - 2], where all four nodes are there; there the slope
/// is nothing.
inline SplineWeights spline_weights(double index, std::int64_t count) {
  const double last = static_cast<double>(count - 2);
  const double x = std::clamp(index, 1.0, last);
  SplineWeights weights;
  weights.first = std::min(static_cast<std::int64_t>(std::floor(x)), count - 3) - 1;
  const double t = x - static_cast<double>(weights.first + 1), r = 1.0 - t;
  weights.value = {r * r * r / 6.0, (3.0 * t * t * t - 6.0 * t * t + 4.0) / 6.0,
                   (3.0 * r * r * r - 6.0 * r * r + 4.0) / 6.0, t * t * t / 6.0};
  if (index >= 1.0 && index <= last)
    weights.slope = {-r * r / 2.0, (3.0 * t * t - 4.0 * t) / 2.0, -(3.0 * r * r - 4.0 * r) / 2.0,
                     t * t / 2.0};
  return weights;
}

}  // namespace ostia::registration
