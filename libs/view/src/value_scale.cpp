#include "ostia/view/value_scale.h"

#include "ostia/core/error.h"
#include "ostia/core/text.h"
#include "ostia/figure/value_colors.h"

#include <algorithm>
#include <cmath>
#include <string>

namespace ostia::view {
figure::Color scale_color(ColorScale scale, double t) {
  if (scale == ColorScale::sequential) return figure::viridis(t);
  return figure::blue_to_vermilion(scale == ColorScale::falling ? 1.0 - t : t);
}

void validate(const ValueScale& scale) {
  if (!std::isfinite(scale.low) || !std::isfinite(scale.high) || !(scale.low < scale.high))
    throw InvalidInput("the colours' range is from " + std::to_string(scale.low) + " to " +
                       std::to_string(scale.high) + "; the first has to be below the second");
}

std::string three_digits(double value) {
  if (!std::isfinite(value)) return "-";
  const double size = std::abs(value);
  if (size == 0.0) return "0";
  if (size < 1e-4 || size >= 1e7) return core::significant_text(value, 3);
  int exponent = static_cast<int>(std::floor(std::log10(size)));
  if (std::round(size / std::pow(10.0, exponent - 2)) >= 1000.0) ++exponent;  // 9.996 is 10.0
  if (exponent <= 2) return core::shown_text(value, 2 - exponent);
  const double unit = std::pow(10.0, exponent - 2);
  return core::shown_text(unit * std::round(value / unit), 0);
}

double range_step(const std::pair<double, double>& range) {
  constexpr double least_steps = 20.0;  // between the ends
  const double most = std::max(std::abs(range.first), std::abs(range.second)),
               span = range.second - range.first;
  if (!std::isfinite(most) || !(span > 0.0)) return 1.0;
  double step = std::pow(10.0, std::floor(std::log10(most)) - 2.0);
  while (step > span / least_steps) step /= 10.0;
  return step;
}

std::pair<double, double> rounded_range(const std::pair<double, double>& range) {
  if (!std::isfinite(range.first) || !std::isfinite(range.second) || !(range.first < range.second))
    return range;
  constexpr double slack = 1e-6;  // of a step: what is a whole number of them stays
  const double per_unit = std::round(1.0 / range_step(range)), step = range_step(range);
  const auto whole = [&](double steps) { return per_unit >= 1.0 ? steps / per_unit : steps * step; };
  return {whole(std::floor(range.first / step + slack)), whole(std::ceil(range.second / step - slack))};
}

std::string range_text(double value, const std::pair<double, double>& range) {
  const int decimals = std::clamp(static_cast<int>(std::ceil(-std::log10(range_step(range)) - 1e-9)), 0, 12);
  const std::string text = std::isfinite(value) ? core::trimmed_text(value, decimals) : "-";
  return text == "-0" ? "0" : text;
}

}  // namespace ostia::view
