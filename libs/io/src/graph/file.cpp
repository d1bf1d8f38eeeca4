#include "graph/formats.h"
#include "surface_formats.h"
#include "vtk/xml.h"

#include "ostia/core/error.h"
#include "ostia/io/graph_file.h"
#include "ostia/io/markups_file.h"
#include "ostia/io/rotterdam_file.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <limits>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::Vec3;

namespace {

/// The head of a VTP: its piece says how many lines and polygons there are.
bool has_lines_alone(const fs::path& path) {
  constexpr std::size_t head_bytes = 1 << 16;
  std::string head(head_bytes, '\0');
  std::ifstream in(path, std::ios::binary);
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  head.resize(static_cast<std::size_t>(in.gcount()));
  const auto has = [&](std::string_view attribute) {
    const std::size_t at = head.find(attribute);
    if (at == std::string::npos) return false;
    const std::size_t quote = at + attribute.size();
    return quote + 1 < head.size() && head[quote + 1] >= '1' && head[quote + 1] <= '9';
  };
  return has("NumberOfLines=") && !has("NumberOfPolys=") && !has("NumberOfStrips=");
}

std::uint64_t mixed(const Vec3& place) {
  std::uint64_t hash = 0;
  for (const double x : {place.x() + 0.0, place.y() + 0.0, place.z() + 0.0}) {  // -0 + 0 is 0
    hash = (hash ^ std::bit_cast<std::uint64_t>(x)) * 0x9E3779B97F4A7C15ULL;
    hash ^= hash >> 32;
  }
  return hash;
}

}  // namespace

std::optional<double> number_or_nan(std::string_view word) {
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  if (word.empty()) return nan;
  const std::optional<double> value = number<double>(word);
  return value && !std::isfinite(*value) ? nan : value;
}

void PointTable::grow() {
  slots_.assign(std::max<std::size_t>(1024, 2 * slots_.size()), -1);
  for (std::size_t i = 0; i < points_.size(); ++i)
    if (points_[i].allFinite()) slots_[slot_of(points_[i])] = static_cast<std::int32_t>(i);
}

/// Where it is, or the free slot where it belongs.
std::size_t PointTable::slot_of(const Vec3& place) const {
  std::size_t slot = mixed(place) & (slots_.size() - 1);
  while (slots_[slot] >= 0 && points_[static_cast<std::size_t>(slots_[slot])] != place)
    slot = (slot + 1) & (slots_.size() - 1);
  return slot;
}

std::int32_t PointTable::find(const Vec3& place) const {
  return slots_.empty() || !place.allFinite() ? -1 : slots_[slot_of(place)];
}

std::int32_t PointTable::index_of(const Vec3& place) {
  const auto next = static_cast<std::int32_t>(points_.size());
  if (!place.allFinite()) {
    points_.push_back(place);
    return next;
  }
  if (2 * (used_ + 1) > slots_.size()) grow();
  std::int32_t& slot = slots_[slot_of(place)];
  if (slot >= 0) return slot;
  slot = next;
  ++used_;
  points_.push_back(place);
  return next;
}

void warn_if_cut(const PieceReader& reader, LoadedGraph& loaded) {
  if (!reader.stopped() && reader.line_number() > 1)
    loaded.warnings.push_back("line " + std::to_string(reader.line_number()) +
                              ", the last one, has no end: the file may be cut short");
}

namespace {

/// Structured points, which an image's reader takes.
bool is_legacy_image(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::string head(4096, '\0');
  in.read(head.data(), static_cast<std::streamsize>(head.size()));
  return upper(head).find("\nDATASET STRUCTURED_POINTS") != std::string::npos;
}

}  // namespace

bool is_graph_file(const fs::path& path) {
  const std::string extension = upper(path.extension().string());
  if (extension == ".VTP") return has_lines_alone(path);
  if (extension == ".VTK") return !legacy_has_polygons(path) && !is_legacy_image(path);
  if (extension == ".JSON") return is_markups_file(path);
  if (extension == ".TXT") return is_rotterdam_line(path);
  static constexpr std::array<std::string_view, 4> known{".SWC", ".CSV", ".GXL", ".XML"};
  static constexpr std::array<std::string_view, 3> tables{"vertex.dat", "edges.dat", "radius.dat"};
  return std::find(known.begin(), known.end(), extension) != known.end() ||
         std::find(tables.begin(), tables.end(), path.filename().string()) != tables.end();
}

LoadedGraph read_graph(const fs::path& path, const core::TaskContext& task) {
  std::error_code error;
  if (!fs::exists(path, error)) throw IoError("cannot read " + path.string() + ": there is no such file");
  if (!fs::is_regular_file(path, error)) refuse(path, "it is no file");
  if (fs::file_size(path, error) == 0) refuse(path, "the file is empty");
  task.set_stage("reading the network");
  const std::string extension = upper(path.extension().string());
  LoadedGraph loaded;
  if (extension == ".VTP" || extension == ".VTK")
    loaded = read_graph_vtk(path, task);
  else if (extension == ".SWC")
    loaded = read_graph_swc(path, task);
  else if (extension == ".CSV")
    loaded = read_graph_csv(path, task);
  else if (extension == ".GXL" || extension == ".XML")
    loaded = read_graph_gxl(path, task);
  else if (extension == ".DAT")
    loaded = read_graph_tables(path, task);
  else if (extension == ".TXT" && is_rotterdam_line(path))
    loaded = read_graph_rotterdam(path);
  else if (is_markups_file(path))
    loaded = read_graph_markups(path);
  else
    refuse(path,
           "a tree ends in .vtp, .vtk, .swc, .csv, .gxl, .xml, .dat or .mrk.json, a line of numbers in .txt");
  if (loaded.graph.edges.empty()) refuse(path, "it has no segments");
  task.throw_if_cancelled();
  task.set_progress(1.0);
  return loaded;
}

std::vector<std::string> write_graph(const fs::path& path, const geometry::VesselGraph& graph,
                                     const core::TaskContext& task) {
  return write_graph(path, graph, {}, task);
}

std::vector<std::string> write_graph(const fs::path& path, const geometry::VesselGraph& graph,
                                     const std::vector<SegmentValues>& values,
                                     const core::TaskContext& task) {
  const auto check = [&](const std::string& what, std::size_t there) {
    if (there != graph.edges.size())
      throw InvalidInput("cannot write " + path.string() + ": there are " + std::to_string(there) + " " +
                         what + " for " + std::to_string(graph.edges.size()) + " segments");
  };
  if (!graph.references.empty()) check("references", graph.references.size());
  for (const SegmentValues& value : values) check("values of " + value.name, value.values.size());
  const auto count = static_cast<std::int64_t>(graph.points.size());
  for (std::size_t e = 0; e < graph.edges.size(); ++e)
    for (const std::int32_t point : {graph.edges[e].from, graph.edges[e].to})
      if (point < 0 || point >= count)
        throw InvalidInput("cannot write " + path.string() + ": segment " + std::to_string(e) +
                           " names a point that is not there; repair the network first");
  const std::string extension = upper(path.extension().string());
  if (extension == ".SWC") {
    std::vector<std::string> told = write_graph_swc(path, graph, task);
    for (const SegmentValues& value : values)
      told.push_back("SWC has no place for the segments' " + value.name);
    return told;
  }
  if (extension == ".VTP")
    write_graph_vtp(path, graph, values);
  else if (extension == ".CSV")
    write_graph_csv(path, graph, values, task);
  else
    throw InvalidInput("cannot write " + path.string() + ": a tree is written as .vtp, .swc or .csv");
  return {};
}

}  // namespace ostia::io
