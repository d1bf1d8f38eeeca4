#include "name_certainty.h"

#include <algorithm>
#include <cmath>

namespace ostia::coronary {

double as_probability(double measure) {
  constexpr double at_half = 0.88, slope = 0.89;  // of the logit
  constexpr double least = 1e-3;
  const double p = std::clamp(measure, least, 1.0 - least);
  if (measure <= 0.0) return 0.0;
  return 1.0 / (1.0 + std::exp(-(at_half + slope * std::log(p / (1.0 - p)))));
}

}  // namespace ostia::coronary
