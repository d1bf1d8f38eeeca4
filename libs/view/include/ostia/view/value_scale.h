#pragma once
/// \file Colours for values on a surface that colour-blind readers can tell apart.

#include "ostia/figure/color.h"

#include <string>

namespace ostia::view {

enum class ColorScale {
  sequential,  ///< viridis (van der Walt and Smith 2015): dark blue, green, yellow, evenly brighter
  diverging,   ///< blue, nearly white in the middle, vermilion: signed errors about zero
};

/// The colour at `t` in [0, 1], clamped; grey where it is not a number.
figure::Color scale_color(ColorScale scale, double t);

/// How values on the wall become colours, and what the bar beside the picture says.
struct ValueScale {
  std::string title = "diameter, mm";
  double low = 1.0, high = 4.0;  ///< values of the first and last colour; low < high
  ColorScale colors = ColorScale::sequential;
};
void validate(const ValueScale& scale);  ///< throws InvalidInput

}  // namespace ostia::view
