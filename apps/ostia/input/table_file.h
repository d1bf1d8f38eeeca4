#pragma once
/// \file Tables of text with a header line.

#include <filesystem>
#include <string>
#include <vector>

namespace ostia::app {

struct Table {
  std::vector<std::string> columns;
  std::vector<std::vector<std::string>> rows;  ///< as wide as `columns`
  std::vector<std::size_t> lines;              ///< where each row begins in the file, from 1
};

/// Reads CSV (RFC 4180: commas, "quoted ""texts""", either line end; a byte order mark and empty lines are
/// skipped). Throws InvalidInput that names file and line: no header, a column without a name or twice, a row
/// of another width, an open quotation; IoError.
Table read_table(const std::filesystem::path& file);

}  // namespace ostia::app
