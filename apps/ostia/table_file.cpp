#include "table_file.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <set>

namespace ostia::app {
namespace {

struct Line {
  std::vector<std::string> cells;
  std::size_t number = 0;
};

/// Goes through the text once, cell by cell.
class Parser {
 public:
  Parser(const std::string& text, const std::filesystem::path& file) : text_(text), file_(file) {
    if (text_.starts_with("\xef\xbb\xbf")) at_ = 3;
  }
  std::vector<Line> lines() {
    std::vector<Line> out;
    while (at_ < text_.size()) {
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
    std::string value;
    if (at_ < text_.size() && text_[at_] == '"') quoted(line, value);
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') value += text_[at_++];
    const bool more = at_ < text_.size() && text_[at_] == ',';
    if (!more && !value.empty() && value.back() == '\r') value.pop_back();
    if (at_ < text_.size()) {
      number_ += more ? 0 : 1;
      ++at_;
    }
    line.cells.push_back(std::move(value));
    return more;
  }
  void quoted(const Line& line, std::string& value) {
    for (++at_; at_ < text_.size(); ++at_) {
      if (text_[at_] == '\n') ++number_;
      if (text_[at_] != '"') {
        value += text_[at_];
      } else if (at_ + 1 < text_.size() && text_[at_ + 1] == '"') {
        value += text_[at_++];
      } else {
        ++at_;
        return;
      }
    }
    throw InvalidInput("cannot use " + file_.string() + ": the quotation in line " +
                       std::to_string(line.number) + " does not end");
  }

  const std::string& text_;
  const std::filesystem::path& file_;
  std::size_t at_ = 0, number_ = 1;
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

std::string csv_line(const std::vector<std::string>& cells) {
  std::string out;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    if (i > 0) out += ',';
    if (cells[i].find_first_of(",\"\n\r") == std::string::npos) {
      out += cells[i];
      continue;
    }
    out += '"';
    for (const char c : cells[i]) out += c == '"' ? std::string("\"\"") : std::string(1, c);
    out += '"';
  }
  return out + "\n";
}

}  // namespace ostia::app
