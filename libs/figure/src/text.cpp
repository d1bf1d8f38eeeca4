#include "text.h"

#include "ostia/core/utf8.h"

#include <charconv>

namespace ostia::figure {

std::string clean_utf8(std::string_view text) {
  std::string result;
  result.reserve(text.size());
  while (!text.empty()) {
    const std::size_t length = core::utf8_length(text);
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
