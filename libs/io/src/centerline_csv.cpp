#include "centerline_csv.h"

#include "line_tree.h"
#include "surface_formats.h"

#include "ostia/core/csv.h"
#include "ostia/core/error.h"
#include "ostia/core/files.h"
#include "ostia/core/text.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <fstream>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::Centerline;
using geometry::Vessel;
using geometry::VesselTree;

namespace {

/// Without the blanks around them.
std::vector<std::string> columns(std::string_view row, std::size_t number, const fs::path& path) {
  std::vector<std::string> out;
  core::CsvCell cell;
  do {
    cell = core::take_csv_cell(row);
    if (!cell.closed) refuse(path, "the quotation in row " + std::to_string(number) + " does not end");
    const std::size_t from = std::min(cell.text.find_first_not_of(' '), cell.text.size());
    out.push_back(cell.text.substr(from, cell.text.find_last_not_of(' ') + 1 - from));
  } while (!cell.last);
  return out;
}

}  // namespace

bool is_table_of_lines(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string header;
  std::getline(in, header);
  for (char& c : header)
    if (c == ',' || c == '\r' || c == '\t') c = ' ';
  Words words(header);
  for (std::string_view word = words.next(); !word.empty(); word = words.next())
    if (const std::string name = upper(word); name == "X1" || name == "PARENT") return false;
  return true;
}

VesselTree read_centerline_table(const fs::path& path) {
  const std::string content = core::read_file(path);
  Words rows(content);
  const std::vector<std::string> header = columns(rows.line(), 1, path);
  const auto column = [&](std::string_view name) {
    const auto found = std::find(header.begin(), header.end(), name);
    return found == header.end() ? -1 : static_cast<int>(found - header.begin());
  };
  const std::array<int, 4> wanted{column("x"), column("y"), column("z"), column("radius")};
  if (*std::min_element(wanted.begin(), wanted.end()) < 0)
    refuse(path, "its first row must name the columns x,y,z,radius");
  const int vessel_column = column("vessel");
  std::vector<FileLine> lines;
  VesselNames names;
  std::string current;
  bool fresh = true;
  for (std::size_t row = 2; !rows.empty(); ++row) {
    const std::string_view text = rows.line();
    if (text.find_first_not_of(" \t") == std::string_view::npos) {
      fresh = true;
      continue;
    }
    const std::vector<std::string> cells = columns(text, row, path);
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < 4; ++i) {
      const auto value = static_cast<std::size_t>(wanted[i]) < cells.size()
                             ? number<double>(cells[static_cast<std::size_t>(wanted[i])])
                             : std::nullopt;
      if (!value || !std::isfinite(*value))
        refuse(path, "row " + std::to_string(row) + ", column " +
                         header[static_cast<std::size_t>(wanted[i])] + " is no number");
      values[i] = *value;
    }
    if (!(values[3] > 0.0)) refuse(path, "row " + std::to_string(row) + ": the radius must be positive");
    const std::string name(vessel_column >= 0 && static_cast<std::size_t>(vessel_column) < cells.size()
                               ? cells[static_cast<std::size_t>(vessel_column)]
                               : "");
    if (fresh || name != current) {
      const auto id = static_cast<std::int32_t>(lines.size());
      lines.push_back({{}, {}, id, id});
      if (!name.empty()) names[id] = name;
    }
    fresh = false;
    current = name;
    lines.back().points.emplace_back(values[0], values[1], values[2]);
    lines.back().radius.push_back(values[3]);
  }
  if (lines.empty()) refuse(path, "it has no points");
  for (const FileLine& line : lines) {
    if (line.points.size() < 2) refuse(path, "a line has fewer than two points");
  }
  return tree_of_lines(lines, names);
}

std::string centerline_table_text(const VesselTree& tree, const std::vector<AlongVessels>& along) {
  std::string out = "vessel,x,y,z,radius,abscissa";
  for (const AlongVessels& one : along) out += ',' + core::csv_cell(one.name);
  out += '\n';
  for (const Vessel& vessel : tree.vessels) {
    const Centerline axis = geometry::vessel_axis(tree, vessel);
    if (vessel.name.find_first_of("\r\n") != std::string::npos)
      throw InvalidInput(
          "the vessel name " + core::csv_cell(vessel.name) +
          " has a line's end, which CSV files of centerlines cannot hold: rename it, or write .vtp");
    const std::string name = core::csv_cell(vessel.name);
    for (std::size_t i = 0; i < axis.size(); ++i) {
      out += name;
      for (const double value :
           {axis.points[i].x(), axis.points[i].y(), axis.points[i].z(), axis.radius[i], axis.abscissa[i]}) {
        out += ',';
        out += core::shortest_text(value);
      }
      for (const AlongVessels& one : along) {
        const double value = one.at(vessel.id, axis.abscissa[i]);
        out += ',';
        if (std::isfinite(value)) out += core::shortest_text(value);
      }
      out += '\n';
    }
  }
  return out;
}

}  // namespace ostia::io
