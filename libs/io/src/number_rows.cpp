#include "number_rows.h"

#include "ostia/core/error.h"

#include <charconv>
#include <cmath>

namespace ostia::io {
namespace {

bool blank(char c) {
  return c == ' ' || c == '\t' || c == '\r';
}

std::string_view trimmed_row(std::string_view text) {
  while (!text.empty() && blank(text.front())) text.remove_prefix(1);
  while (!text.empty() && blank(text.back())) text.remove_suffix(1);
  return text;
}

std::vector<std::string_view> words_of(std::string_view line, char separator) {
  std::vector<std::string_view> words;
  line = trimmed_row(line);
  while (!line.empty()) {
    std::size_t end = 0;
    while (end < line.size() && !(separator == ' ' ? blank(line[end]) : line[end] == separator)) ++end;
    words.push_back(trimmed_row(line.substr(0, end)));
    if (end == line.size()) break;
    line.remove_prefix(end + 1);
    if (separator == ' ') line = trimmed_row(line);
  }
  return words;
}

}  // namespace

std::vector<NumberRow> rows_of(std::string_view text, char separator) {
  std::vector<NumberRow> rows;
  constexpr std::string_view byte_order_mark = "\xEF\xBB\xBF";
  if (text.substr(0, byte_order_mark.size()) == byte_order_mark) text.remove_prefix(byte_order_mark.size());
  std::size_t number = 0, from = 0;
  while (from < text.size()) {
    const std::size_t to = std::min(text.find('\n', from), text.size());
    std::string_view line = text.substr(from, to - from);
    from = to + 1;
    ++number;
    line = line.substr(0, line.find('#'));
    NumberRow row{number, words_of(line, separator)};
    if (!row.words.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

double number_in(std::string_view word, const std::filesystem::path& path, std::size_t line) {
  constexpr std::size_t most_shown = 40;  // a file of other bytes may be one long word
  const std::string shown(word.substr(0, most_shown));
  double value = 0.0;
  if (!word.empty() && word.front() == '+') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) {
    const bool comma = word.find(',') != std::string_view::npos;
    throw InvalidInput(path.string() + ": line " + std::to_string(line) + ": \"" + shown +
                       "\" is no finite number" + (comma ? "; write decimals with a point" : ""));
  }
  return value;
}

}  // namespace ostia::io
