#pragma once
/// \file Text files of numbers in columns.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::io {

struct NumberRow {
  std::size_t line = 0;  ///< from 1
  std::vector<std::string_view> words;
};

/// The words of each line that holds any; what follows `#` is left out. `separator` ' ' is any run of blanks.
std::vector<NumberRow> rows_of(std::string_view text, char separator = ' ');
/// Throws InvalidInput naming file, line and word for what is no finite number.
double number_in(std::string_view word, const std::filesystem::path& path, std::size_t line);

}  // namespace ostia::io
