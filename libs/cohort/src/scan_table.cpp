#include "ostia/cohort/scan_table.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/utf8.h"

#include <unistd.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <unordered_map>
#include <utility>

namespace ostia::cohort {
namespace fs = std::filesystem;

/// Goes through the table once, a row at a time.
class RowReader {
 public:
  explicit RowReader(const ScanTable& table)
      : table_(table),
        rest_(std::string_view(table.text_).substr(table.rows_from_)),
        line_(table.first_line_) {}
  /// False at the end. Empty lines are passed over.
  bool next() {
    while (!rest_.empty()) {
      cells.clear();
      begins = line_;
      while (take()) {
      }
      if (cells.size() > 1 || !cells[0].empty()) return true;
    }
    return false;
  }
  const std::string& cell(std::size_t column) const {
    static const std::string empty;
    return column == ScanTable::Columns::none ? empty : cells[column];
  }
  /// Of the table's text, behind what was read.
  std::size_t offset() const { return table_.text_.size() - rest_.size(); }
  std::size_t line() const { return line_; }
  std::size_t begins = 1;
  std::vector<std::string> cells;

 private:
  bool take() {
    core::CsvCell one = core::take_csv_cell(rest_);
    if (!one.closed)
      throw InvalidInput("cannot use " + table_.file_.string() + ": the quotation in line " +
                         std::to_string(begins) + " does not end");
    line_ += one.line_ends;
    cells.push_back(std::move(one.text));
    return !one.last;
  }
  const ScanTable& table_;
  std::string_view rest_;
  std::size_t line_;
};

namespace {

constexpr std::uint64_t most_table_bytes = 1ULL << 30;
constexpr std::size_t most_columns = 64, most_cell_bytes = 4096, most_id_bytes = 256;

/// Enough of a digest to tell a million texts apart, in 16 bytes.
struct Mark {
  std::uint64_t a = 0, b = 0;
  bool operator==(const Mark&) const = default;
};
struct MarkHash {
  std::size_t operator()(const Mark& mark) const { return mark.a; }
};
Mark mark_of(const std::string& text) {
  const std::string digest = core::sha256(text);
  return {std::stoull(digest.substr(0, 16), nullptr, 16), std::stoull(digest.substr(16, 16), nullptr, 16)};
}
using FirstLines = std::unordered_map<Mark, std::size_t, MarkHash>;

/// As it is in a message: short, and nothing that moves a terminal's cursor.
std::string shown_cell(std::string_view cell) {
  std::string out = "\"";
  for (const char c : cell.substr(0, 80)) out += static_cast<unsigned char>(c) < 32 || c == 127 ? '?' : c;
  return out + (cell.size() > 80 ? "...\"" : "\"");
}

bool is_formula(const std::string& cell) {
  return !cell.empty() && std::string_view("=+-@").find(cell.front()) != std::string_view::npos;
}

bool has_controls(const std::string& cell) {
  return std::ranges::any_of(cell, [](char c) { return static_cast<unsigned char>(c) < 32 || c == 127; });
}

struct Fault {
  std::string reason, text;
};

std::optional<Fault> fault_of_cell(const char* column, const std::string& cell) {
  const std::string begin = std::string("its ") + column + " " + shown_cell(cell) + " ";
  if (cell.size() > most_cell_bytes) return Fault{"too long", begin + "is too long"};
  if (!core::is_utf8(cell)) return Fault{"not UTF-8", std::string("its ") + column + " is not UTF-8"};
  if (is_formula(cell))
    return Fault{"formula",
                 begin + "begins as a spreadsheet's formula does (= + - @); write ./ before a path"};
  if (has_controls(cell))
    return Fault{"control character", begin + "holds a line's end or a control character"};
  return std::nullopt;
}

std::optional<Fault> fault_of_scan(const std::string& text, const fs::path& scan) {
  const std::string begin = "its scan " + shown_cell(text) + " ";
  if (text.starts_with("pacs:") || text.find("://") != std::string::npos)
    return Fault{"on a server", begin + "is on a server; fetch it first (ostia pacs get)"};
  std::error_code error;
  const fs::file_status status = fs::status(scan, error);
  if (status.type() == fs::file_type::not_found) return Fault{"missing", begin + "is not there"};
  if (error || ::access(scan.c_str(), R_OK) != 0) return Fault{"unreadable", begin + "cannot be read"};
  if (scan.extension() == ".ostia")
    return Fault{"a case", begin + "is a case; a cohort begins with images and masks"};
  const bool folder = fs::is_directory(status);
  if (!folder && !fs::is_regular_file(status))
    return Fault{"no file", begin + "is neither a file nor a folder"};
  if (fs::is_empty(scan, error)) return Fault{"empty", begin + "is empty"};
  return std::nullopt;
}

fs::path path_of(const std::string& text, const fs::path& table) {
  return (fs::absolute(table).parent_path() / text).lexically_normal();
}

/// What rows must not share with an earlier one.
std::optional<Fault> fault_of_twins(FirstLines& known, const std::string& key, std::size_t line,
                                    const std::string& what) {
  const auto [first, is_new] = known.emplace(mark_of(key), line);
  if (is_new) return std::nullopt;
  return Fault{"twice", what + " is in line " + std::to_string(first->second) + " already"};
}

}  // namespace

std::string name_of(ScanKind kind) {
  return kind == ScanKind::mask ? "mask" : "image";
}

ScanTable ScanTable::read(const fs::path& file) {
  ScanTable table;
  table.file_ = file;
  table.text_ = core::read_file(file, most_table_bytes);
  const auto refuse = [&](const std::string& what) {
    throw InvalidInput("cannot use " + file.string() + ": " + what);
  };
  if (table.text_.starts_with("\xef\xbb\xbf")) table.rows_from_ = 3;
  RowReader header(table);
  if (!header.next()) refuse("it is empty; its first line names the columns id and scan");
  if (header.cells.size() > most_columns)
    refuse("it has " + std::to_string(header.cells.size()) + " columns; " + std::to_string(most_columns) +
           " are the most: leave out what a cohort has no use for");
  Columns& columns = table.columns_;
  columns.count = header.cells.size();
  std::vector<std::string> names = header.cells;
  std::ranges::sort(names);
  if (names.front().empty() || std::ranges::adjacent_find(names) != names.end())
    refuse("its columns need names, each another one");
  const auto find = [&](const char* name) {
    const auto at = std::ranges::find(header.cells, name);
    return at == header.cells.end() ? Columns::none : static_cast<std::size_t>(at - header.cells.begin());
  };
  columns.id = find("id");
  columns.scan = find("scan");
  if (columns.id == Columns::none || columns.scan == Columns::none)
    refuse("it needs the columns id and scan (and may have patient, kind, series)");
  columns.patient = find("patient");
  columns.kind = find("kind");
  columns.series = find("series");
  for (std::size_t i = 0; i < columns.count; ++i)
    if (i != columns.id && i != columns.scan && i != columns.patient && i != columns.kind &&
        i != columns.series)
      table.unused_.push_back(header.cells[i]);
  table.rows_from_ = header.offset();
  table.first_line_ = header.line();
  return table;
}

std::string ScanTable::digest() const {
  return core::sha256(text_);
}

namespace {

class RowCheck {
 public:
  explicit RowCheck(const fs::path& table) : table_(table) {}
  struct Cells {
    const std::string &id, &scan, &patient, &kind, &series;
  };
  std::optional<Fault> operator()(const Cells& c, std::size_t line) {
    if (auto fault = fault_of_text(c)) return fault;
    const fs::path scan = path_of(c.scan, table_);
    if (auto fault = fault_of_scan(c.scan, scan)) return fault;
    if (auto fault = fault_of_twins(ids_, c.id, line, "the id " + shown_cell(c.id))) return fault;
    return fault_of_twins(scans_, scan.string() + '\n' + c.series, line, "the scan " + shown_cell(c.scan));
  }

 private:
  static std::optional<Fault> fault_of_text(const Cells& c) {
    if (c.id.empty()) return Fault{"no id", "it has no id"};
    if (c.scan.empty()) return Fault{"no scan", "it has no scan"};
    if (c.id.size() > most_id_bytes || c.patient.size() > most_id_bytes)
      return Fault{"too long", "an id has " + std::to_string(most_id_bytes) + " bytes at most"};
    for (const auto& [column, cell] :
         {std::pair{"id", &c.id}, std::pair{"scan", &c.scan}, std::pair{"patient", &c.patient},
          std::pair{"kind", &c.kind}, std::pair{"series", &c.series}})
      if (auto fault = fault_of_cell(column, *cell)) return fault;
    if (!c.kind.empty() && c.kind != "image" && c.kind != "mask")
      return Fault{"unknown kind", "its kind " + shown_cell(c.kind) + " is none of image, mask"};
    if (c.series.find_first_not_of("0123456789.") != std::string::npos)
      return Fault{"no UID", "its series " + shown_cell(c.series) + " is no UID: digits and dots"};
    return std::nullopt;
  }
  const fs::path& table_;
  FirstLines ids_, scans_;
};

}  // namespace

TableCheck ScanTable::check(const core::TaskContext& task) const {
  TableCheck out;
  out.unused_columns = unused_;
  RowCheck fault_of(file_);
  RowReader reader(*this);
  while (reader.next()) {
    if (++out.rows % 1024 == 0) {
      task.throw_if_cancelled();
      task.set_progress(static_cast<double>(reader.offset()) / static_cast<double>(text_.size()));
    }
    std::optional<Fault> fault;
    if (reader.cells.size() != columns_.count)
      fault = Fault{"width", "it has " + std::to_string(reader.cells.size()) + " cells for " +
                                 std::to_string(columns_.count) + " columns"};
    else
      fault = fault_of({reader.cell(columns_.id), reader.cell(columns_.scan), reader.cell(columns_.patient),
                        reader.cell(columns_.kind), reader.cell(columns_.series)},
                       reader.begins);
    if (fault) out.refused.push_back({reader.begins, std::move(fault->reason), std::move(fault->text)});
  }
  if (out.rows == 0) throw InvalidInput("cannot use " + file_.string() + ": it has no row");
  return out;
}

void ScanTable::for_each(const TableCheck& check, const std::function<void(const ScanRow&)>& take) const {
  RowReader reader(*this);
  auto refused = check.refused.begin();
  while (reader.next()) {
    if (refused != check.refused.end() && refused->line == reader.begins) {
      ++refused;
      continue;
    }
    const std::string &id = reader.cell(columns_.id), &patient = reader.cell(columns_.patient);
    take({reader.begins, id, patient.empty() ? id : patient, path_of(reader.cell(columns_.scan), file_),
          reader.cell(columns_.series),
          reader.cell(columns_.kind) == "mask" ? ScanKind::mask : ScanKind::image});
  }
}

}  // namespace ostia::cohort
