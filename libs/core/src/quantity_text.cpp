#include "ostia/core/quantity_text.h"

#include "ostia/core/text.h"

#include <cmath>

namespace ostia::core {

std::string calibre_text(std::optional<double> mm) {
  return shown_text(mm, std::abs(mm.value_or(0.0)) < 9.995 ? 2 : 1);
}

std::string length_text(std::optional<double> mm) {
  return shown_text(mm, 1);
}

std::string area_text(std::optional<double> mm2) {
  const double size = std::abs(mm2.value_or(0.0));
  return shown_text(mm2, size < 9.995 ? 2 : size < 99.95 ? 1 : 0);
}

std::string volume_text(std::optional<double> mm3) {
  return shown_text(mm3, std::abs(mm3.value_or(0.0)) < 99.95 ? 1 : 0);
}

std::string percent_text(std::optional<double> percent) {
  return shown_text(percent, 0);
}

std::string stenosis_text(std::optional<double> percent) {
  constexpr double shut = 100.0 - 1e-9;  // what is left of 100 by rounding
  const bool nearly = percent && *percent<shut&& * percent> 99.0;
  return shown_text(nearly ? std::optional(99.0) : percent, 0);
}

std::string hu_text(std::optional<double> hu) {
  return shown_text(hu, 0);
}

std::string measured_angle_text(std::optional<double> deg) {
  return shown_text(deg, 1);
}

std::string set_angle_text(std::optional<double> deg) {
  return shown_text(deg, 0);
}

std::string ratio_text(std::optional<double> value) {
  return shown_text(value, 2);
}

}  // namespace ostia::core
