#include "input/table_file.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <set>
#include <string_view>

namespace ostia::app {
namespace {

struct Line {
  std::vector<std::string> cells;
  std::size_t number = 0;
};

/// Goes through the text once, cell by cell.
class Parser {
 public:
  Parser(std::string_view text, const std::filesystem::path& file) : rest_(text), file_(file) {
    if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);
  }
  std::vector<Line> lines() {
    std::vector<Line> out;
    while (!rest_.empty()) {
      Line line{{}, number_};
      while (cell(line)) {
      }
      if (line.cells.size() > 1 || !line.cells[0].empty()) out.push_back(std::move(line));
    }
    return out;
  }

 private:
  /// Adds a cell; false where the line ends behind it.
  bool cell(Line& line) {
    core::CsvCell one = core::take_csv_cell(rest_);
    if (!one.closed)
      throw InvalidInput("cannot use " + file_.string() + ": the quotation in line " +
                         std::to_string(line.number) + " does not end");
    number_ += one.line_ends;
    line.cells.push_back(std::move(one.text));
    return !one.last;
  }

  std::string_view rest_;
  const std::filesystem::path& file_;
  std::size_t number_ = 1;
};

}  // namespace

Table read_table(const std::filesystem::path& file) {
  const auto refuse = [&](const std::string& what) {
    throw InvalidInput("cannot use " + file.string() + ": " + what);
  };
  const std::string text = core::read_file(file, 256 << 20);
  std::vector<Line> lines = Parser(text, file).lines();
  if (lines.size() < 2) refuse("a table has a line of column names and at least one row");
  Table out;
  out.columns = std::move(lines[0].cells);
  if (std::set<std::string>(out.columns.begin(), out.columns.end()).size() != out.columns.size() ||
      std::count(out.columns.begin(), out.columns.end(), "") != 0)
    refuse("its columns need names, each another one");
  for (std::size_t i = 1; i < lines.size(); ++i) {
    if (lines[i].cells.size() != out.columns.size())
      refuse("line " + std::to_string(lines[i].number) + " has " + std::to_string(lines[i].cells.size()) +
             " cells for " + std::to_string(out.columns.size()) + " columns");
    out.rows.push_back(std::move(lines[i].cells));
    out.lines.push_back(lines[i].number);
  }
  return out;
}

}  // namespace ostia::app
