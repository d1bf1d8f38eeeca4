#pragma once
/// \file Tables of values by scan, as files have them.

#include <filesystem>
#include <map>
#include <set>
#include <string>
#include <tuple>
#include <vector>

namespace ostia::cohort {

struct TidyValue {
  std::string scan, level, item, measure, unit;
  double value = 0.0;
};

struct TidyTable {
  std::vector<TidyValue> values;  ///< numbers alone; texts are left out
  std::set<std::string> scans;    ///< all that have a row
};

/// Reads CSV with a column `scan`. With `measure` and `value` (and, where wanted, `level`, `item`, `unit`) a
/// row is a value; without them it is a scan, and each other column a measure of level "scan". Empty cells
/// are no value. Throws InvalidInput that names file and line: no `scan`, a row of another width, a value
/// twice (but in a table with a column `entry`, as `write_measure_table` makes it, the first one counts);
/// IoError.
TidyTable read_tidy_table(const std::filesystem::path& file);

}  // namespace ostia::cohort
