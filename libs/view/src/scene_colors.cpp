#include "ostia/view/scene_colors.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <span>
#include <string>

namespace ostia::view {
namespace {

using figure::Color;

constexpr Color of_bytes(int r, int g, int b) {
  return {r / 255.0, g / 255.0, b / 255.0, 1.0};
}

/// Viridis at eighths of its range; linear between them it is off by less than 2 % of a component.
constexpr std::array<Color, 9> viridis{
    of_bytes(68, 1, 84),    of_bytes(71, 44, 122),  of_bytes(59, 81, 139),
    of_bytes(44, 113, 142), of_bytes(33, 144, 141), of_bytes(39, 173, 129),
    of_bytes(92, 200, 99),  of_bytes(170, 220, 50), of_bytes(253, 231, 37)};
constexpr std::array<Color, 3> blue_to_vermilion{of_bytes(0, 114, 178), of_bytes(240, 240, 240),
                                                 of_bytes(213, 94, 0)};
constexpr Color unknown = of_bytes(128, 128, 128);

Color between(std::span<const Color> anchors, double t) {
  const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(anchors.size() - 1);
  const std::size_t i = std::min(static_cast<std::size_t>(place), anchors.size() - 2);
  return figure::mixed(anchors[i], anchors[i + 1], place - static_cast<double>(i));
}

}  // namespace

Color scale_color(ColorScale scale, double t) {
  if (std::isnan(t)) return unknown;
  return scale == ColorScale::sequential ? between(viridis, t) : between(blue_to_vermilion, t);
}

void validate(const ValueScale& scale) {
  if (!std::isfinite(scale.low) || !std::isfinite(scale.high) || !(scale.low < scale.high))
    throw InvalidInput("the colours' range is from " + std::to_string(scale.low) + " to " +
                       std::to_string(scale.high) + "; the first has to be below the second");
}

}  // namespace ostia::view
