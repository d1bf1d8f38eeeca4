#include "ostia/io/rotterdam_file.h"

#include "number_rows.h"

#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <cmath>
#include <fstream>

namespace ostia::io {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t most_rotterdam_bytes = 1ULL << 30;

[[noreturn]] void refuse(const fs::path& path, std::size_t line, const std::string& what) {
  throw InvalidInput(path.string() + ": line " + std::to_string(line) + ": " + what);
}

struct Table {
  std::vector<std::vector<double>> rows;
  std::vector<std::size_t> lines;
};

Table table_of(const fs::path& path, std::size_t least_columns, std::size_t most_columns,
               const std::string& columns) {
  const std::string text = core::read_file(path, most_rotterdam_bytes);
  Table table;
  for (const NumberRow& row : rows_of(text)) {
    if (row.words.size() < least_columns || row.words.size() > most_columns)
      refuse(path, row.line,
             "has " + std::to_string(row.words.size()) + " columns where " + columns +
                 " are expected, with blanks between them");
    std::vector<double> numbers;
    for (const std::string_view word : row.words) numbers.push_back(number_in(word, path, row.line));
    if (!table.rows.empty() && table.rows.back().size() != numbers.size())
      refuse(path, row.line, "has another number of columns than the lines before");
    table.rows.push_back(std::move(numbers));
    table.lines.push_back(row.line);
  }
  if (table.rows.empty()) throw InvalidInput(path.string() + " is empty: it holds no point");
  return table;
}

std::vector<Vec3> points_of(const fs::path& path, const Table& table) {
  std::vector<Vec3> points;
  for (const std::vector<double>& row : table.rows) points.emplace_back(row[0], row[1], row[2]);
  if (points.size() < 2) throw InvalidInput(path.string() + " holds one point; a line needs at least two");
  if (count_repeated(points) + 1 == points.size())
    throw InvalidInput(path.string() + ": all of its " + std::to_string(points.size()) +
                       " points are at one place; a line needs at least two places");
  return points;
}

constexpr int decimals = 6;  // a nanometre
constexpr double least_length_mm = 1e-6;
constexpr double most_length_mm = 1e9;

[[noreturn]] void refuse_to_write(const fs::path& path, const std::string& what) {
  throw InvalidInput("cannot write " + path.string() + ": " + what);
}

std::string text_of(const fs::path& path, const Vec3& p) {
  if (!p.allFinite()) refuse_to_write(path, "a point is not finite");
  if (!(p.cwiseAbs().maxCoeff() < most_length_mm))
    refuse_to_write(path, "a point is 1e9 mm away from the origin or more");
  std::string out;
  for (int axis = 0; axis < 3; ++axis) {
    if (axis > 0) out += ' ';
    out += core::fixed_text(p[axis], decimals);
  }
  return out;
}

/// The points' texts; refuses what the reader would refuse.
std::vector<std::string> texts_of(const fs::path& path, const std::vector<Vec3>& points) {
  if (points.size() < 2)
    refuse_to_write(path,
                    "there are " + std::to_string(points.size()) + " points; a line needs at least two");
  std::vector<std::string> texts;
  for (std::size_t i = 0; i < points.size(); ++i) {
    texts.push_back(text_of(path, points[i]));
    if (i > 0 && texts[i] == texts[i - 1])
      refuse_to_write(path, "point " + std::to_string(i) + " repeats the point before it (to 1e-6 mm)");
  }
  return texts;
}

void require_positive(const fs::path& path, const std::vector<double>& values, const char* what) {
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!(values[i] >= least_length_mm && values[i] < most_length_mm))
      refuse_to_write(path, std::string(what) + " of point " + std::to_string(i) + " is not positive");
}

bool repeats(const std::vector<Vec3>& points, std::size_t i) {
  return i > 0 && points[i] == points[i - 1];
}

}  // namespace

std::size_t count_repeated(const std::vector<Vec3>& points) {
  std::size_t count = 0;
  for (std::size_t i = 0; i < points.size(); ++i) count += repeats(points, i);
  return count;
}

RotterdamReference without_repeated(const RotterdamReference& line) {
  RotterdamReference out;
  for (std::size_t i = 0; i < line.points.size(); ++i) {
    if (repeats(line.points, i)) continue;
    out.points.push_back(line.points[i]);
    if (i < line.radius.size()) out.radius.push_back(line.radius[i]);
    if (i < line.observer_spread.size()) out.observer_spread.push_back(line.observer_spread[i]);
  }
  return out;
}

RotterdamReference read_rotterdam_reference(const fs::path& path) {
  const Table table = table_of(path, 5, 5, "five (x y z r io)");
  RotterdamReference reference;
  reference.points = points_of(path, table);
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    const double r = table.rows[i][3], io = table.rows[i][4];
    if (r <= 0.0) refuse(path, table.lines[i], "the radius must be positive, is " + std::to_string(r));
    if (io <= 0.0)
      refuse(path, table.lines[i], "the observers' spread must be positive, is " + std::to_string(io));
    reference.radius.push_back(r);
    reference.observer_spread.push_back(io);
  }
  return reference;
}

RotterdamReference read_rotterdam_axis(const fs::path& path) {
  const Table table = table_of(path, 3, 5, "three to five (x y z r io)");
  if (table.rows.front().size() == 5) return read_rotterdam_reference(path);
  RotterdamReference line;
  line.points = points_of(path, table);
  if (table.rows.front().size() == 3) return line;
  for (std::size_t i = 0; i < table.rows.size(); ++i) {
    if (table.rows[i][3] <= 0.0)
      refuse(path, table.lines[i], "the radius must be positive, is " + std::to_string(table.rows[i][3]));
    line.radius.push_back(table.rows[i][3]);
  }
  return line;
}

bool is_rotterdam_line(const fs::path& path) {
  constexpr std::size_t head_bytes = 4096;
  std::string head(head_bytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  if (head.size() == head_bytes) head.resize(head.rfind('\n') + 1);  // the last row may be cut
  const std::vector<NumberRow> rows = rows_of(head);
  if (rows.size() < 2) return false;
  try {
    for (const NumberRow& row : rows) {
      if (row.words.size() < 3 || row.words.size() > 5) return false;
      for (const std::string_view word : row.words) number_in(word, path, row.line);
    }
  } catch (const InvalidInput&) {
    return false;
  }
  return true;
}

void write_rotterdam_reference(const fs::path& path, const RotterdamReference& reference) {
  if (reference.radius.size() != reference.points.size() ||
      reference.observer_spread.size() != reference.points.size())
    throw InvalidInput("cannot write " + path.string() + ": points, radii and spreads differ in number");
  const std::vector<std::string> points = texts_of(path, reference.points);
  require_positive(path, reference.radius, "the radius");
  require_positive(path, reference.observer_spread, "the observers' spread");
  std::string out;
  for (std::size_t i = 0; i < points.size(); ++i) {
    out += points[i] + ' ';
    out += core::fixed_text(reference.radius[i], decimals);
    out += ' ';
    out += core::fixed_text(reference.observer_spread[i], decimals);
    out += '\n';
  }
  core::write_file(path, out);
}

std::vector<Vec3> read_rotterdam_line(const fs::path& path) {
  return points_of(path, table_of(path, 3, 5, "three (x y z)"));
}

void write_rotterdam_line(const fs::path& path, const std::vector<Vec3>& points) {
  std::string out;
  for (const std::string& point : texts_of(path, points)) out += point + '\n';
  core::write_file(path, out);
}

Vec3 read_rotterdam_point(const fs::path& path) {
  const Table table = table_of(path, 3, 3, "three (x y z)");
  if (table.rows.size() != 1)
    throw InvalidInput(path.string() + " holds " + std::to_string(table.rows.size()) +
                       " points where one is expected");
  return {table.rows[0][0], table.rows[0][1], table.rows[0][2]};
}

void write_rotterdam_point(const fs::path& path, const Vec3& point) {
  core::write_file(path, text_of(path, point) + "\n");
}

}  // namespace ostia::io
