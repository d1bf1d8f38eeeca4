#pragma once
/// \file The median of a few values.

#include <algorithm>
#include <cstddef>
#include <vector>

namespace ostia::coronary {

inline double median(std::vector<double> values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace ostia::coronary
