#include "ostia/analysis/tree_ruler.h"
#include "ostia/core/error.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <cmath>

namespace ostia::analysis {

GridScale grid_scale(double size_mm, int least_lines) {
  if (!(size_mm > 0.0) || !std::isfinite(size_mm) || least_lines < 2)
    throw InvalidInput("a grid needs a size above 0 mm and two lines at least");
  const double most = size_mm / (least_lines - 1) * (1.0 + 1e-12);
  const double decade = std::pow(10.0, std::floor(std::log10(most)));
  GridScale scale;
  scale.step_mm = decade;
  for (const double factor : {2.0, 5.0, 10.0})
    if (factor * decade <= most) scale.step_mm = factor * decade;
  const bool small = scale.step_mm < 0.1 * (1.0 - 1e-9), large = scale.step_mm >= 10.0 * (1.0 - 1e-9);
  scale.unit = small ? "um" : large ? "cm" : "mm";
  scale.per_mm = small ? 1000.0 : large ? 0.1 : 1.0;
  return scale;
}

std::vector<double> grid_ticks(double low, double high, double step_mm) {
  if (!(step_mm > 0.0) || !std::isfinite(low) || !std::isfinite(high))
    throw InvalidInput("a grid needs a step above 0 mm and finite bounds");
  constexpr double almost = 1e-9, most = 10000.0;
  const double first = std::ceil(low / step_mm - almost), last = std::floor(high / step_mm + almost);
  if (last - first >= most) throw InvalidInput("a grid of more than 10000 lines");
  std::vector<double> ticks;
  for (double i = first; i <= last; i += 1.0) ticks.push_back(i == 0.0 ? 0.0 : i * step_mm);
  return ticks;
}

std::string tick_text(double value_mm, const GridScale& scale) {
  const double step = scale.step_mm * scale.per_mm;
  const int decimals = std::max(0, static_cast<int>(-std::floor(std::log10(step) + 1e-9)));
  return core::fixed_text(value_mm * scale.per_mm, decimals) + " " + scale.unit;
}

}  // namespace ostia::analysis
