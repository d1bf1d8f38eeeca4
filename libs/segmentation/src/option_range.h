#pragma once
/// \file Options out of their range, told in one way.

#include "ostia/core/error.h"

#include <cstdio>

namespace ostia::segmentation::detail {

/// Throws InvalidInput ("lumen boundary: step_mm is 5; it has to be in [0.1, 2] mm") unless low <= value <=
/// high; `range` is how the message gives the bounds.
inline void require_range(const char* what, const char* name, double value, double low, double high,
                          const char* range) {
  if (value >= low && value <= high) return;
  char text[200];
  std::snprintf(text, sizeof text, "%s: %s is %g; it has to be in %s", what, name, value, range);
  throw InvalidInput(text);
}

}  // namespace ostia::segmentation::detail
