#include "ostia/view/value_scale.h"

#include "ostia/core/error.h"
#include "ostia/figure/value_colors.h"

#include <cmath>
#include <string>

namespace ostia::view {
figure::Color scale_color(ColorScale scale, double t) {
  return scale == ColorScale::sequential ? figure::viridis(t) : figure::blue_to_vermilion(t);
}

void validate(const ValueScale& scale) {
  if (!std::isfinite(scale.low) || !std::isfinite(scale.high) || !(scale.low < scale.high))
    throw InvalidInput("the colours' range is from " + std::to_string(scale.low) + " to " +
                       std::to_string(scale.high) + "; the first has to be below the second");
}

}  // namespace ostia::view
