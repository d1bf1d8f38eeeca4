#pragma once
/// \file Colours for values, and the bar that says what they mean.

#include "ostia/figure/picture.h"

#include <string>

namespace ostia::figure {

/// Viridis (van der Walt and Smith 2015), evenly brighter from dark blue to yellow, at `t` in [0, 1],
/// clamped; grey where it is not a number.
Color viridis(double t);
/// Blue, nearly white in the middle, vermilion, for signed values about zero; `t` as above.
Color blue_to_vermilion(double t);

struct ValueBar {
  std::string title;             ///< with its unit: "wall shear stress, Pa"
  double low = 0.0, high = 1.0;  ///< values of the first and last colour; low < high
  bool more_above = false;       ///< larger values have the last colour too: ">= 5"
  bool root = false;             ///< colours go with the square root of the distance from `low`
  int width_px = 150, height_px = 640;
  Look look = Look::light;
};
/// An upright bar of viridis with round values beside it. Throws InvalidInput for an empty range.
Picture value_bar(const ValueBar& bar);

/// The smallest of 1, 2, 2.5, 3, 4, 5, 6, 8 times a power of ten that is not below `value`; 1 where it is not
/// positive.
double round_above(double value);

}  // namespace ostia::figure
