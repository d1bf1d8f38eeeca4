#pragma once
/// \file Tables as RFC 4180 has them: cells between commas, "texts ""with"" quotes".

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::core {

/// In quotes where it holds a comma, a quote or a line's end; else as it is.
std::string csv_cell(std::string_view text);
/// One line with its end, "\n".
std::string csv_line(const std::vector<std::string>& cells);

struct CsvCell {
  std::string text;
  bool last = false;          ///< of its line
  bool closed = true;         ///< false: the text ends within quotes
  std::size_t line_ends = 0;  ///< that were passed, within quotes and behind the last cell
};
/// Takes a cell off `rest` with the comma or line's end ("\n" or "\r\n") behind it.
CsvCell take_csv_cell(std::string_view& rest);

}  // namespace ostia::core
