#pragma once
/// \file Colours for values on a surface that colour-blind readers can tell apart.

#include "ostia/figure/color.h"

#include <string>
#include <utility>

namespace ostia::view {

enum class ColorScale {
  sequential,  ///< viridis (van der Walt and Smith 2015): dark blue, green, yellow, evenly brighter
  falling,     ///< vermilion, nearly white in the middle, blue: ratios of which low ones matter
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

/// A number for a reader: three digits that count, without an exponent from 1e-4 to 1e7: "0.123", "12.3",
/// "12300". "-" where it is not finite.
std::string three_digits(double value);
/// The step of a range's numbers: three digits of the larger end count, more where the ends would hardly
/// differ.
double range_step(const std::pair<double, double>& range);
/// The same, outwards to whole steps: low <= range.first, range.second <= high. Ends that are not finite or
/// out of order stay as they are.
std::pair<double, double> rounded_range(const std::pair<double, double>& range);
/// An end of such a range, or a number between, without zeros at the end: "1.25", "98".
std::string range_text(double value, const std::pair<double, double>& range);

}  // namespace ostia::view
