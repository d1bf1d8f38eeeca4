#pragma once
/// \file The readers and writers behind graph_file.h, one source each, and what they share.

#include "piece_reader.h"

#include "ostia/io/graph_file.h"

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ostia::io {

LoadedGraph read_graph_vtk(const std::filesystem::path& path, const core::TaskContext& task);
LoadedGraph read_graph_swc(const std::filesystem::path& path, const core::TaskContext& task);
LoadedGraph read_graph_csv(const std::filesystem::path& path, const core::TaskContext& task);
LoadedGraph read_graph_gxl(const std::filesystem::path& path, const core::TaskContext& task);
LoadedGraph read_graph_markups(const std::filesystem::path& path);
LoadedGraph read_graph_rotterdam(const std::filesystem::path& path);
LoadedGraph read_graph_tables(const std::filesystem::path& path, const core::TaskContext& task);
void write_graph_vtp(const std::filesystem::path& path, const geometry::VesselGraph& graph,
                     const std::vector<SegmentValues>& values);
std::vector<std::string> write_graph_swc(const std::filesystem::path& path, geometry::VesselGraph graph,
                                         const core::TaskContext& task);
void write_graph_csv(const std::filesystem::path& path, const geometry::VesselGraph& graph,
                     const std::vector<SegmentValues>& values, const core::TaskContext& task);

/// A number; NaN for "", "nan", "inf" and what else is no finite one. Nothing for what is no number at all.
std::optional<double> number_or_nan(std::string_view word);

/// Samples that name their parents, as SWC has them, until all are known.
class SampleTree {
 public:
  struct Sample {
    std::int64_t id = 0, parent = -1;  ///< the parent -1: a root
    geometry::Vec3 place;
    double radius = 0.0;
    std::int64_t line = 0;
  };
  void add(const Sample& sample);
  std::size_t size() const { return ids_.size(); }
  /// Moves out of this object. A parent that is not there is point -1.
  LoadedGraph graph();

 private:
  std::vector<std::int64_t> ids_, parents_, lines_;
  std::vector<double> radii_;
  std::vector<geometry::Vec3> points_;
};

/// Points, each place once: equal bit for bit, 0 and -0 alike. Those that are not finite are never joined.
class PointTable {
 public:
  explicit PointTable(std::vector<geometry::Vec3>& points) : points_(points) {}
  std::int32_t index_of(const geometry::Vec3& place);
  /// -1 for a place that is not there.
  std::int32_t find(const geometry::Vec3& place) const;

 private:
  void grow();
  std::size_t slot_of(const geometry::Vec3& place) const;
  std::vector<geometry::Vec3>& points_;
  std::vector<std::int32_t> slots_;  // open addressing; -1: free
  std::size_t used_ = 0;
};

/// Some editors begin a text with these three bytes.
inline std::string_view without_byte_order_mark(std::string_view first_line) {
  if (first_line.starts_with("\xEF\xBB\xBF")) first_line.remove_prefix(3);
  return first_line;
}

/// Adds a warning where the last line of a file has no end.
void warn_if_cut(const PieceReader& reader, LoadedGraph& loaded);

}  // namespace ostia::io
