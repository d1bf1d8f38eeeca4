#include "text.h"

#include <array>
#include <charconv>
#include <cstdint>

namespace ostia::figure {
namespace {

/// Length of the well-formed UTF-8 character at the start of `text`, 0 if there is none (overlong forms,
/// surrogates and values past U+10FFFF are not well-formed).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return static_cast<std::uint8_t>(text[i]); };
  const std::uint8_t first = byte(0);
  if (first < 0x80) return 1;
  const std::size_t length = first >= 0xF0 ? 4 : first >= 0xE0 ? 3 : 2;
  if (first < 0xC2 || first > 0xF4 || text.size() < length) return 0;
  std::uint32_t code = first & (0xFFU >> (length + 1));
  for (std::size_t i = 1; i < length; ++i) {
    if ((byte(i) & 0xC0) != 0x80) return 0;
    code = (code << 6) | (byte(i) & 0x3FU);
  }
  constexpr std::array<std::uint32_t, 5> kLeast{0, 0, 0x80, 0x800, 0x10000};
  if (code < kLeast[length] || code > 0x10FFFF || (code >= 0xD800 && code <= 0xDFFF)) return 0;
  return length;
}

}  // namespace

std::string clean_utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = character_length(text);
    if (length == 0) {
      result += "\xEF\xBF\xBD";
      text.remove_prefix(1);
      continue;
    }
    const auto first = static_cast<unsigned char>(text[0]);
    const bool control = (first < 0x20 && first != '\t' && first != '\n') || first == 0x7F;
    if (!control) result.append(text.substr(0, length));
    text.remove_prefix(length);
  }
  return result;
}

bool looks_numeric(std::string_view cell) {
  if (!cell.empty() && (cell[0] == '+' || cell[0] == '<' || cell[0] == '>')) cell.remove_prefix(1);
  while (!cell.empty() && cell[0] == ' ') cell.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(cell.data(), cell.data() + cell.size(), value);
  if (error != std::errc()) return false;
  const std::string_view rest = cell.substr(static_cast<std::size_t>(end - cell.data()));
  return rest.empty() || rest[0] == ' ' || rest[0] == '%' || rest[0] == ',';
}

std::vector<bool> numeric_columns(std::size_t columns, const std::vector<std::vector<std::string>>& rows) {
  std::vector<bool> numeric(columns, false);
  for (std::size_t c = 0; c < columns; ++c) {
    bool all = true;
    bool any = false;
    for (const auto& row : rows) {
      if (row[c].empty() || row[c] == "-" || row[c] == "\xE2\x80\x93") continue;
      (looks_numeric(row[c]) ? any : all) = looks_numeric(row[c]);
    }
    numeric[c] = all && any;
  }
  return numeric;
}

}  // namespace ostia::figure
