#include "reference_values.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>

namespace ostia::cohort {
namespace {

constexpr std::size_t most_columns = 1000;

std::optional<double> number_of(std::string_view text) {
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return {};
  return value;
}

class TidyReader {
 public:
  explicit TidyReader(const std::filesystem::path& file)
      : file_(file), text_(core::read_file(file, 1ULL << 31)) {}
  TidyTable read();

 private:
  [[noreturn]] void refuse(const std::string& why) const {
    throw InvalidInput("cannot use " + file_.string() + ": line " + std::to_string(line_) + ": " + why);
  }
  std::vector<std::string> next_row();
  std::optional<std::size_t> column(const char* name) const {
    const auto at = std::ranges::find(columns_, name);
    if (at == columns_.end()) return {};
    return static_cast<std::size_t>(at - columns_.begin());
  }
  void add(TidyTable& out, TidyValue value, std::string_view text);
  void take_value(TidyTable& out, const std::vector<std::string>& row);
  void take_scan(TidyTable& out, const std::vector<std::string>& row);

  const std::filesystem::path file_;
  const std::string text_;
  std::string_view rest_ = text_;
  std::size_t line_ = 1, next_line_ = 1;
  std::vector<std::string> columns_;
  std::set<std::tuple<std::string, std::string, std::string, std::string>> met_;
};

std::vector<std::string> TidyReader::next_row() {
  std::vector<std::string> out;
  line_ = next_line_;
  while (true) {
    core::CsvCell cell = core::take_csv_cell(rest_);
    next_line_ += cell.line_ends;
    if (!cell.closed) refuse("a quotation has no end");
    out.push_back(std::move(cell.text));
    if (out.size() > most_columns) refuse("it has more than " + std::to_string(most_columns) + " columns");
    if (cell.last) return out;
  }
}

void TidyReader::add(TidyTable& out, TidyValue value, std::string_view text) {
  if (text.empty()) return;
  if (!met_.emplace(value.scan, value.level, value.item, value.measure).second) {
    if (column("entry")) return;  // two of one name in a table of ours: the first one counts
    refuse(value.measure + " of " + value.scan + (value.item.empty() ? "" : ", " + value.item) +
           " is there twice; leave one out");
  }
  const auto number = number_of(text);
  if (!number) return;
  value.value = *number;
  out.values.push_back(std::move(value));
}

void TidyReader::take_value(TidyTable& out, const std::vector<std::string>& row) {
  const auto cell = [&](const char* name, const char* otherwise) {
    const auto at = column(name);
    return at ? row[*at] : std::string(otherwise);
  };
  add(out,
      {cell("scan", ""), cell("level", "scan"), cell("item", ""), cell("measure", ""), cell("unit", ""), 0.0},
      cell("value", ""));
}

void TidyReader::take_scan(TidyTable& out, const std::vector<std::string>& row) {
  const std::size_t scan = *column("scan");
  for (std::size_t i = 0; i < row.size(); ++i)
    if (i != scan) add(out, {row[scan], "scan", "", columns_[i], "", 0.0}, row[i]);
}

TidyTable TidyReader::read() {
  if (rest_.starts_with("\xEF\xBB\xBF")) rest_.remove_prefix(3);
  columns_ = next_row();
  if (!column("scan")) refuse("it has no column `scan`, which holds pseudonyms");
  const bool is_tidy = column("measure") && column("value");
  TidyTable out;
  while (!rest_.empty()) {
    const std::vector<std::string> row = next_row();
    if (row.size() == 1 && row[0].empty()) continue;
    if (row.size() != columns_.size())
      refuse("it has " + std::to_string(row.size()) + " cells, and the columns are " +
             std::to_string(columns_.size()));
    out.scans.insert(row[*column("scan")]);
    is_tidy ? take_value(out, row) : take_scan(out, row);
  }
  return out;
}

}  // namespace

TidyTable read_tidy_table(const std::filesystem::path& file) {
  return TidyReader(file).read();
}

}  // namespace ostia::cohort
