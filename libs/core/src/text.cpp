#include "ostia/core/text.h"

#include <fmt/format.h>

#include <array>
#include <charconv>
#include <cmath>

namespace ostia::core {

std::string fixed_text(double value, int decimals) {
  return fmt::format("{:.{}f}", value, decimals);
}

std::string signed_text(double value, int decimals) {
  return fmt::format("{:+.{}f}", value, decimals);
}

std::string significant_text(double value, int digits) {
  return fmt::format("{:.{}g}", value, digits);
}

std::string shortest_text(double value) {
  // fmt's "{}" would write the same digits, yet take to an exponent at other numbers than files of ours do.
  std::array<char, 32> text{};
  return {text.data(), std::to_chars(text.data(), text.data() + text.size(), value).ptr};
}

std::string trimmed_text(double value, int most_decimals) {
  std::string text = fixed_text(value, most_decimals);
  if (text.find('.') == std::string::npos) return text;
  text.erase(text.find_last_not_of('0') + 1);
  if (text.back() == '.') text.pop_back();
  return text;
}

std::string rounded_text(double value, int decimals) {
  const double scale = std::pow(10.0, decimals);
  // Adding zero takes the sign off a negative zero.
  return fixed_text(std::round(value * scale) / scale + 0.0, decimals);
}

std::string cut_text(double value, int decimals) {
  const std::string text = fixed_text(value, 6);
  const std::size_t point = text.find('.');
  return point == std::string::npos ? text : text.substr(0, point + 1 + static_cast<std::size_t>(decimals));
}

std::string mm_text(double value, int decimals) {
  return fixed_text(value, decimals) + " mm";
}

std::string fixed_or_dash(double value, int decimals) {
  return std::isfinite(value) ? fixed_text(value, decimals) : "-";
}

std::string shown_text(double value, int decimals, std::string_view unknown) {
  if (!std::isfinite(value)) return std::string(unknown);
  std::string text = fixed_text(value, decimals);
  if (text.front() == '-' && text.find_first_not_of("-0.") == std::string::npos) text.erase(0, 1);
  return text;
}

std::string shown_text(const std::optional<double>& value, int decimals, std::string_view unknown) {
  return value ? shown_text(*value, decimals, unknown) : std::string(unknown);
}

}  // namespace ostia::core
