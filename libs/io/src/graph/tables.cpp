// The three tables that OpenCCO's tools write: places, pairs of points, radii.

#include "graph/formats.h"
#include "surface_formats.h"

#include "ostia/core/error.h"

#include <array>
#include <cmath>
#include <limits>

namespace ostia::io {
namespace fs = std::filesystem;

namespace {

/// Rows of at least `Columns` numbers; those beyond are left, and so are lines that begin with #.
template <std::size_t Columns, class Take>
void read_rows(const fs::path& path, LoadedGraph& loaded, const core::TaskContext& task, const Take& take) {
  if (!fs::exists(path))
    refuse(path,
           "there is no such file, and a tree of tables needs vertex.dat, edges.dat and radius.dat in one "
           "folder");
  PieceReader reader(path, task);
  std::string_view line;
  std::size_t rows = 0;
  while (reader.line(line)) {
    if (reader.line_number() == 1) line = without_byte_order_mark(line);
    Words words(line);
    std::array<double, Columns> values{};
    std::string_view word = words.next();
    if (word.empty() || word.front() == '#') continue;
    for (double& value : values) {
      const auto found = word.empty() ? std::nullopt : number_or_nan(word);
      if (!found)
        reader.refuse_line("it has no " + std::to_string(Columns) + " numbers",
                           std::to_string(rows) + " rows were read before it");
      value = *found;
      word = words.next();
    }
    take(values, static_cast<std::int64_t>(reader.line_number()));
    ++rows;
  }
  const std::size_t before = loaded.warnings.size();
  warn_if_cut(reader, loaded);
  if (loaded.warnings.size() > before)
    loaded.warnings.back() = path.filename().string() + ": " + loaded.warnings.back();
}

std::int32_t index_of(double value, std::size_t points) {
  const bool there = value >= 0.0 && value < static_cast<double>(points) && value == std::floor(value);
  return there ? static_cast<std::int32_t>(value) : -1;
}

}  // namespace

LoadedGraph read_graph_tables(const fs::path& path, const core::TaskContext& task) {
  const fs::path folder = path.parent_path();
  LoadedGraph loaded;
  loaded.reference_name = "line";
  geometry::VesselGraph& graph = loaded.graph;
  read_rows<3>(folder / "vertex.dat", loaded, task.sub(0.0, 0.4),
               [&](const auto& p, std::int64_t) { graph.points.emplace_back(p[0], p[1], p[2]); });
  std::vector<double> radii;
  read_rows<1>(folder / "radius.dat", loaded, task.sub(0.4, 0.6),
               [&](const auto& r, std::int64_t) { radii.push_back(r[0]); });
  read_rows<2>(folder / "edges.dat", loaded, task.sub(0.6, 1.0), [&](const auto& e, std::int64_t line) {
    const std::int32_t to = index_of(e[1], graph.points.size());
    const double radius =
        to >= 0 && radii.size() == graph.points.size() ? radii[static_cast<std::size_t>(to)] : std::nan("");
    graph.edges.push_back({index_of(e[0], graph.points.size()), to, radius, radius});
    graph.references.push_back(line);
  });
  if (radii.size() != graph.points.size() && radii.size() != graph.edges.size())
    refuse(folder / "radius.dat", "it has " + std::to_string(radii.size()) + " radii for " +
                                      std::to_string(graph.points.size()) + " points and " +
                                      std::to_string(graph.edges.size()) + " segments");
  if (radii.size() != graph.points.size())
    for (std::size_t e = 0; e < radii.size(); ++e)
      graph.edges[e].radius_from = graph.edges[e].radius_to = radii[e];
  return loaded;
}

}  // namespace ostia::io
