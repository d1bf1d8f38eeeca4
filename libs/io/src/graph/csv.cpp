// Networks as tables: segments, samples or points along lines, by the header.

#include "ostia/core/csv.h"

#include "graph/formats.h"
#include "surface_formats.h"
#include "text_writer.h"

#include "ostia/core/error.h"

#include <algorithm>
#include <array>
#include <limits>
#include <unordered_set>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::Vec3;

namespace {

std::string_view trimmed_cell(std::string_view text) {
  const std::size_t from = text.find_first_not_of(" \t");
  if (from == std::string_view::npos) return {};
  return text.substr(from, text.find_last_not_of(" \t") + 1 - from);
}

/// The cells of one row after another; no copies where nothing is quoted.
class Cells {
 public:
  const std::vector<std::string_view>& of(std::string_view row, const PieceReader& reader) {
    cells_.clear();
    if (row.find('"') != std::string_view::npos) return quoted(row, reader);
    for (;;) {
      const std::size_t comma = row.find(',');
      cells_.push_back(trimmed_cell(row.substr(0, comma)));
      if (comma == std::string_view::npos) return cells_;
      row.remove_prefix(comma + 1);
    }
  }

 private:
  const std::vector<std::string_view>& quoted(std::string_view row, const PieceReader& reader) {
    texts_.clear();
    core::CsvCell cell;
    do {
      cell = core::take_csv_cell(row);
      if (!cell.closed) reader.refuse_line("its quotation does not end", "");
      texts_.push_back(cell.text);
    } while (!cell.last);
    for (const std::string& text : texts_) cells_.push_back(trimmed_cell(text));
    return cells_;
  }
  std::vector<std::string_view> cells_;
  std::vector<std::string> texts_;
};

class TableReader {
 public:
  TableReader(const fs::path& path, const core::TaskContext& task)
      : path_(path), reader_(path, task), table_(loaded_.graph.points) {
    loaded_.reference_name = "line";
  }

  LoadedGraph read() {
    std::string_view line;
    while (reader_.line(line) && trimmed_cell(line).empty()) {
    }
    line = without_byte_order_mark(line);
    const bool named = take_header(cells_.of(line, reader_));
    if (column("x1") >= 0) {
      if (column("reference") >= 0) loaded_.reference_name = "reference";
      read_rows({"x1", "y1", "z1", "x2", "y2", "z2"},
                {{"radius1", "r1", "radius"}, {"radius2", "r2", "radius"}, {"reference"}},
                &TableReader::segment);
    } else if (column("parent") >= 0) {
      read_rows({"x", "y", "z", "id", "parent"}, {{"radius", "r"}}, &TableReader::sample);
    } else {
      read_points(named ? std::string_view{} : line);
    }
    if (samples_.size() > 0) loaded_ = samples_.graph();
    warn_if_cut(reader_, loaded_);
    return std::move(loaded_);
  }

 private:
  using Row = std::vector<std::string_view>;
  using Columns = std::vector<std::string>;

  int column(std::string_view name) const {
    const auto found = std::find(header_.begin(), header_.end(), name);
    return found == header_.end() ? -1 : static_cast<int>(found - header_.begin());
  }
  /// False for a table whose first row is numbers: x, y, z and perhaps the radius.
  bool take_header(const Row& row) {
    const bool numbers =
        row.size() >= 3 && row.size() <= 4 && std::all_of(row.begin(), row.end(), [](std::string_view cell) {
          return !cell.empty() && number<double>(cell).has_value();
        });
    if (numbers) {
      header_ = {"x", "y", "z"};
      if (row.size() == 4) header_.push_back("radius");
      return false;
    }
    for (const std::string_view cell : row) {
      std::string name(cell);
      std::transform(name.begin(), name.end(), name.begin(),
                     [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
      header_.push_back(name);
    }
    return true;
  }

  void read_rows(const Columns& needed, const std::vector<Columns>& wished,
                 void (TableReader::*take)(const Row&)) {
    find_columns(needed, wished);
    std::string_view line;
    while (reader_.line(line)) {
      if (trimmed_cell(line).empty()) continue;
      (this->*take)(cells_.of(line, reader_));
    }
  }

  /// Those needed, then those wished for by the first of their names that is there, or -1.
  void find_columns(const Columns& needed, const std::vector<Columns>& wished) {
    require(needed);
    for (const std::string& name : needed) columns_.push_back(column(name));
    for (const Columns& names : wished) {
      const auto there =
          std::find_if(names.begin(), names.end(), [&](const auto& n) { return column(n) >= 0; });
      columns_.push_back(there == names.end() ? -1 : column(*there));
    }
  }

  void require(const Columns& needed) const {
    for (const std::string& name : needed)
      if (column(name) < 0)
        refuse(path_, "its first row has no column " + name +
                          "; a tree's table has the columns x1,y1,z1,radius1,x2,y2,z2,radius2 or "
                          "id,x,y,z,radius,parent or x,y,z,radius");
  }

  std::string so_far() const {
    return std::to_string(loaded_.graph.edges.size() + samples_.size()) + " segments were read before it";
  }

  /// The cell of one of `columns_`; empty for a column that is not there.
  std::string_view cell(const Row& row, std::size_t which) const {
    if (columns_[which] < 0) return {};
    const auto at = static_cast<std::size_t>(columns_[which]);
    if (at < row.size()) return row[at];
    const std::string end = reader_.stopped() ? "" : "the file ends within it: ";
    reader_.refuse_line(end + "it has " + std::to_string(row.size()) + " of its " +
                            std::to_string(header_.size()) + " columns",
                        so_far());
  }
  [[noreturn]] void refuse_cell(std::string_view text, std::size_t which, const char* no) const {
    reader_.refuse_line("column " + header_[static_cast<std::size_t>(columns_[which])] + ": \"" +
                            std::string(text.substr(0, 40)) + "\" is no " + no,
                        so_far());
  }
  double value(const Row& row, std::size_t which) const {
    const std::string_view text = cell(row, which);
    const std::optional<double> found = number_or_nan(text);
    if (!found) refuse_cell(text, which, "number");
    return *found;
  }
  std::int64_t whole(const Row& row, std::size_t which) const {
    const std::string_view text = cell(row, which);
    if (text.empty()) return -1;
    const auto found = number<std::int64_t>(text);
    if (!found) refuse_cell(text, which, "whole number");
    return *found;
  }
  Vec3 place(const Row& row, std::size_t x) const {
    return {value(row, x), value(row, x + 1), value(row, x + 2)};
  }
  std::int64_t line_number() const { return static_cast<std::int64_t>(reader_.line_number()); }

  void add_edge(std::int32_t from, std::int32_t to, double radius_from, double radius_to,
                std::int64_t reference) {
    loaded_.graph.edges.push_back({from, to, radius_from, radius_to});
    loaded_.graph.references.push_back(reference);
  }

  void segment(const Row& row) {
    const std::int32_t from = table_.index_of(place(row, 0));
    add_edge(from, table_.index_of(place(row, 3)), value(row, 6), value(row, 7),
             columns_[8] < 0 ? line_number() : whole(row, 8));
  }

  void sample(const Row& row) {
    samples_.add({whole(row, 3), whole(row, 4), place(row, 0), value(row, 5), line_number()});
  }

  /// Points along lines; `first` is a row that was no header.
  void read_points(std::string_view first) {
    find_columns({"x", "y", "z"}, {{"radius", "r"}, {"vessel"}});
    if (!first.empty()) point(cells_.of(first, reader_));
    std::string_view line;
    while (reader_.line(line)) {
      if (trimmed_cell(line).empty())
        last_ = -1;
      else
        point(cells_.of(line, reader_));
    }
  }

  void point(const Row& row) {
    const Vec3 here = place(row, 0);
    const double radius = value(row, 3);
    const std::string_view name = cell(row, 4);
    const std::int32_t index = table_.index_of(here);
    if (last_ >= 0 && name == vessel_ && is_new(last_, index))
      add_edge(last_, index, last_radius_, radius, line_number());
    last_ = index;
    last_radius_ = radius;
    vessel_ = name;
  }

  /// Named vessels repeat the way that they share from the root.
  bool is_new(std::int32_t from, std::int32_t to) {
    constexpr int half = 32;
    return columns_[4] < 0 || steps_.insert((static_cast<std::int64_t>(from) << half) | to).second;
  }

  fs::path path_;
  PieceReader reader_;
  LoadedGraph loaded_;
  PointTable table_;
  SampleTree samples_;
  Cells cells_;
  Columns header_;
  std::vector<int> columns_;
  std::int32_t last_ = -1;
  double last_radius_ = 0.0;
  std::string vessel_;
  std::unordered_set<std::int64_t> steps_;
};

}  // namespace

LoadedGraph read_graph_csv(const fs::path& path, const core::TaskContext& task) {
  return TableReader(path, task).read();
}

void write_graph_csv(const fs::path& path, const geometry::VesselGraph& graph,
                     const std::vector<SegmentValues>& values, const core::TaskContext& task) {
  TextWriter out(path, task);
  out.text("x1,y1,z1,radius1,x2,y2,z2,radius2");
  if (!graph.references.empty()) out.text(",reference");
  for (const SegmentValues& value : values) out.text("," + value.name);
  out.text("\n");
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const geometry::GraphEdge& edge = graph.edges[e];
    const Vec3& a = graph.points[static_cast<std::size_t>(edge.from)];
    const Vec3& b = graph.points[static_cast<std::size_t>(edge.to)];
    out.first_number(a.x());
    for (const double x : {a.y(), a.z(), edge.radius_from, b.x(), b.y(), b.z(), edge.radius_to})
      out.number(',', x);
    const auto add = [&](std::int64_t whole) {
      out.text(",");
      out.whole(whole);
    };
    if (!graph.references.empty()) add(graph.references[e]);
    for (const SegmentValues& value : values) add(value.values[e]);
    out.text("\n");
  }
  out.commit();
}

}  // namespace ostia::io
