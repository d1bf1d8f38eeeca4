#include "ostia/view/scene_colors.h"

#include "ostia/core/error.h"
#include "ostia/figure/value_colors.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>

namespace ostia::view {
namespace {

using figure::Color;

constexpr Color of_bytes(int r, int g, int b) {
  return {r / 255.0, g / 255.0, b / 255.0, 1.0};
}

constexpr std::array<Color, 3> blue_to_vermilion{of_bytes(0, 114, 178), of_bytes(240, 240, 240),
                                                 of_bytes(213, 94, 0)};
constexpr Color unknown = of_bytes(128, 128, 128);

/// At `t` in [0, 1], clamped.
Color diverging(double t) {
  const double place = 2.0 * std::clamp(t, 0.0, 1.0);
  return place < 1.0 ? figure::mixed(blue_to_vermilion[0], blue_to_vermilion[1], place)
                     : figure::mixed(blue_to_vermilion[1], blue_to_vermilion[2], place - 1.0);
}

}  // namespace

Color scale_color(ColorScale scale, double t) {
  if (std::isnan(t)) return unknown;
  return scale == ColorScale::sequential ? figure::viridis(t) : diverging(t);
}

void validate(const ValueScale& scale) {
  if (!std::isfinite(scale.low) || !std::isfinite(scale.high) || !(scale.low < scale.high))
    throw InvalidInput("the colours' range is from " + std::to_string(scale.low) + " to " +
                       std::to_string(scale.high) + "; the first has to be below the second");
}

}  // namespace ostia::view
