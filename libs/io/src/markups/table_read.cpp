#include "formats.h"

#include "ostia/core/csv.h"
#include "ostia/core/files.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>

namespace ostia::io::markups {
namespace {

namespace fs = std::filesystem;
using geometry::Vec3;

constexpr std::uint64_t most_table_bytes = 256ULL << 20;
constexpr std::size_t no_column = static_cast<std::size_t>(-1);

std::string trimmed_cell(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front()))) text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back()))) text.remove_suffix(1);
  return std::string(text);
}

/// "X (mm)", "x_mm" and "x" are "x".
std::string column_name(const std::string& cell) {
  std::string name;
  for (const char c : cell) {
    if (!std::isalpha(static_cast<unsigned char>(c))) break;
    name += static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
  }
  return name;
}

std::optional<double> finite_number(std::string_view text) {
  if (!text.empty() && text.front() == '+') text.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc{} || end != text.data() + text.size() || !(std::abs(value) <= most_mm))
    return std::nullopt;
  return value;
}

struct TableRow {
  std::size_t line = 0;
  std::vector<std::string> cells;  ///< one, empty, for an empty row
};

/// Which column holds what.
struct Columns {
  std::array<std::size_t, 3> place{no_column, no_column, no_column};
  std::size_t label = no_column, list = no_column, defined = no_column;
};

bool is_blank(const TableRow& row) {
  return std::all_of(row.cells.begin(), row.cells.end(), [](const std::string& c) { return c.empty(); });
}

std::vector<TableRow> rows_in(const fs::path& path, std::string_view text, char separator) {
  std::vector<TableRow> rows;
  std::size_t line = 1;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find('\n'), text.size());
    TableRow row{line, {}};
    std::string content(text.substr(0, end));
    if (separator != ',') std::replace(content.begin(), content.end(), separator, ',');
    std::string_view rest(content);
    core::CsvCell cell;
    do {
      cell = core::take_csv_cell(rest);
      if (!cell.closed) refuse(path, "line " + std::to_string(line) + ": its quotation does not end");
      row.cells.push_back(trimmed_cell(cell.text));
    } while (!cell.last);
    rows.push_back(std::move(row));
    if (rows.size() > most_points + 100) refuse(path, "it has more than a million points");
    text.remove_prefix(std::min(end + 1, text.size()));
    ++line;
  }
  return rows;
}

const std::string& cell_of(const TableRow& row, std::size_t column) {
  static const std::string none;
  return column < row.cells.size() ? row.cells[column] : none;
}

Vec3 place_in(const fs::path& path, const TableRow& row, const Columns& columns) {
  Vec3 place;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::string& cell = cell_of(row, columns.place[axis]);
    const auto value = finite_number(cell);
    if (!value)
      refuse(path, "line " + std::to_string(row.line) + ": \"" + cell.substr(0, 40) +
                       "\" is no coordinate; a row is x,y,z[,label], finite numbers with a decimal point");
    place[static_cast<Eigen::Index>(axis)] = *value;
  }
  return place;
}

/// A header's columns; nothing where the row begins with three numbers.
std::optional<Columns> header_of(const fs::path& path, const TableRow& row, double& mirror, bool& told) {
  if (row.cells.size() >= 3 && finite_number(row.cells[0]) && finite_number(row.cells[1]) &&
      finite_number(row.cells[2]))
    return std::nullopt;
  std::vector<std::string> names;
  for (const std::string& cell : row.cells) names.push_back(column_name(cell));
  const auto at = [&](const char* name) {
    const auto found = std::find(names.begin(), names.end(), name);
    return found == names.end() ? no_column : static_cast<std::size_t>(found - names.begin());
  };
  Columns columns;
  for (const auto& axes : {std::array{"x", "y", "z"}, std::array{"l", "p", "s"}, std::array{"r", "a", "s"}}) {
    columns.place = {at(axes[0]), at(axes[1]), at(axes[2])};
    if (*std::max_element(columns.place.begin(), columns.place.end()) == no_column) continue;
    told = std::string_view(axes[0]) != "x";
    mirror = std::string_view(axes[0]) == "r" ? -1.0 : 1.0;
    columns.label = at("label") != no_column ? at("label") : at("name");
    columns.list = at("vessel");
    columns.defined = at("defined");
    return columns;
  }
  refuse(path, "line " + std::to_string(row.line) +
                   ": neither three numbers nor a header that names x,y,z (or r,a,s or l,p,s)");
}

char separator_in(const fs::path& path, std::string_view text) {
  const std::string_view first = text.substr(0, text.find('\n'));
  if (path.extension() == ".tsv" || first.find('\t') != std::string_view::npos) return '\t';
  return first.find(';') != std::string_view::npos && first.find(',') == std::string_view::npos ? ';' : ',';
}

std::string_view without_mark(std::string_view text) {
  if (text.starts_with("\xEF\xBB\xBF")) text.remove_prefix(3);
  return text;
}

void require_points(const fs::path& path, const MarkupsFile& file) {
  if (file.markups.empty()) refuse(path, "it has no point");
}

void add_undefined(std::size_t count, MarkupsFile& file) {
  if (count > 0)
    file.warnings.push_back("it has " + points_text(count) + " whose position is not defined: left out");
}

/// What the comments at the head of an .fcsv file say.
struct FcsvHead {
  Columns columns{{1, 2, 3}, 0};  // label,x,y,z,sel,vis as Slicer 3 had them
  double mirror = -1.0;           // RAS where nothing is said
  std::size_t named = 0;          // columns that are named
  std::string name;
};

void take_comment(const fs::path& path, std::string_view line, std::size_t number, FcsvHead& head) {
  const std::size_t sign = line.find('=');
  if (sign == std::string_view::npos) return;
  const std::string key = trimmed_cell(line.substr(1, sign - 1)), value = trimmed_cell(line.substr(sign + 1));
  if (key == "name") head.name = value;
  if (key == "Markups fiducial file version") head.columns = {{1, 2, 3}, 11};
  if (key == "CoordinateSystem") {
    if (value == "0" || value == "RAS") {
      head.mirror = -1.0;
    } else if (value == "1" || value == "LPS") {
      head.mirror = 1.0;
    } else {
      refuse(path, "line " + std::to_string(number) + ": the coordinate system \"" + value.substr(0, 40) +
                       "\" is neither RAS (0) nor LPS (1)");
    }
  }
  if (key == "columns") {
    const std::vector<TableRow> names = rows_in(path, value, ',');
    head.columns = {};
    head.named = names[0].cells.size();
    for (std::size_t i = 0; i < head.named; ++i) {
      const std::string& one = names[0].cells[i];
      if (one == "x") head.columns.place[0] = i;
      if (one == "y") head.columns.place[1] = i;
      if (one == "z") head.columns.place[2] = i;
      if (one == "label") head.columns.label = i;
    }
  }
}

}  // namespace

MarkupsFile read_table(const fs::path& path) {
  const std::string content = core::read_file(path, most_table_bytes);
  const std::string_view text = without_mark(content);
  MarkupsFile file;
  file.frame_told = false;
  double mirror = 1.0;
  std::optional<Columns> columns;
  std::size_t undefined = 0;
  bool fresh = true;
  for (const TableRow& row : rows_in(path, text, separator_in(path, text))) {
    if (is_blank(row) || row.cells[0].starts_with("#")) {
      fresh = fresh || is_blank(row);
      continue;
    }
    if (!columns) {
      columns = header_of(path, row, mirror, file.frame_told);
      if (columns) continue;
      columns = Columns{{0, 1, 2}, 3};
    }
    const std::string& defined = cell_of(row, columns->defined);
    if (defined == "0" || column_name(defined) == "false") {
      ++undefined;
      continue;
    }
    const Vec3 place = place_in(path, row, *columns);
    const std::string& list = cell_of(row, columns->list);
    if (fresh || file.markups.empty() || file.markups.back().name != list) file.markups.push_back({});
    fresh = false;
    Markup& markup = file.markups.back();
    markup.name = list;
    markup.points.emplace_back(mirror * place.x(), mirror * place.y(), place.z());
    markup.labels.push_back(cell_of(row, columns->label));
  }
  add_undefined(undefined, file);
  require_points(path, file);
  return file;
}

MarkupsFile read_fcsv(const fs::path& path) {
  const std::string content = core::read_file(path, most_table_bytes);
  FcsvHead head;
  MarkupsFile file;
  Markup markup;
  std::size_t undefined = 0;
  for (const TableRow& row : rows_in(path, without_mark(content), ',')) {
    if (is_blank(row)) continue;
    if (row.cells[0].starts_with("#")) {
      std::string line;
      for (const std::string& cell : row.cells) line += (line.empty() ? "" : ",") + cell;
      take_comment(path, line, row.line, head);
      continue;
    }
    // Behind the columns that it names Slicer 5 writes each point's status, 2 where its position is defined.
    const std::string& status = cell_of(row, head.named == 14 ? 14 : no_column);
    if (status == "0" || status == "1" || status == "3") {
      ++undefined;
      continue;
    }
    const Vec3 place = place_in(path, row, head.columns);
    markup.points.emplace_back(head.mirror * place.x(), head.mirror * place.y(), place.z());
    markup.labels.push_back(cell_of(row, head.columns.label));
  }
  markup.name = head.name;
  if (!markup.points.empty()) file.markups.push_back(std::move(markup));
  add_undefined(undefined, file);
  require_points(path, file);
  return file;
}

}  // namespace ostia::io::markups
