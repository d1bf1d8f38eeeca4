#include "ostia/core/csv.h"

#include <algorithm>

namespace ostia::core {

std::string csv_cell(std::string_view text) {
  if (text.find_first_of(",\"\n\r") == std::string_view::npos) return std::string(text);
  std::string cell = "\"";
  for (const char c : text) cell += c == '"' ? std::string("\"\"") : std::string(1, c);
  return cell + '"';
}

std::string csv_line(const std::vector<std::string>& cells) {
  std::string line;
  for (std::size_t i = 0; i < cells.size(); ++i) line += (i > 0 ? "," : "") + csv_cell(cells[i]);
  return line + "\n";
}

CsvCell take_csv_cell(std::string_view& rest) {
  CsvCell cell;
  std::size_t at = 0;
  if (rest.starts_with('"')) {
    cell.closed = false;
    for (at = 1; at < rest.size() && !cell.closed; ++at) {
      if (rest[at] == '\n') ++cell.line_ends;
      const bool quote = rest[at] == '"', doubled = quote && at + 1 < rest.size() && rest[at + 1] == '"';
      if (quote && !doubled)
        cell.closed = true;
      else
        cell.text += rest[doubled ? at++ : at];
    }
  }
  const std::size_t end = std::min(rest.find_first_of(",\n", at), rest.size());
  std::string_view unquoted = rest.substr(at, end - at);
  cell.last = end == rest.size() || rest[end] == '\n';
  // One within quotes belongs to the text.
  if (cell.last && unquoted.ends_with('\r')) unquoted.remove_suffix(1);
  cell.text += unquoted;
  if (end < rest.size() && cell.last) ++cell.line_ends;
  rest.remove_prefix(std::min(end + 1, rest.size()));
  return cell;
}

}  // namespace ostia::core
