// Samples that name their parents: SWC.

#include "graph/formats.h"
#include "surface_formats.h"
#include "text_writer.h"

#include "ostia/core/error.h"
#include "ostia/geometry/graph_repair.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

namespace ostia::io {
namespace fs = std::filesystem;

using geometry::GraphEdge;
using geometry::Vec3;
using geometry::VesselGraph;

namespace {

constexpr std::array<const char*, 7> column_names{"id", "type", "x", "y", "z", "radius", "parent"};

std::string shown(std::string_view word) {
  return "\"" + std::string(word.substr(0, 40)) + "\"";
}

/// Ids with the indices of their samples, for those that are not simply counted up.
class IdTable {
 public:
  explicit IdTable(const std::vector<std::int64_t>& ids) : ids_(ids) {
    constexpr std::int64_t most = std::numeric_limits<std::int64_t>::max();
    for (std::size_t i = 1; i < ids.size() && counted_; ++i)
      counted_ = ids[i - 1] < most && ids[i] == ids[i - 1] + 1;
    if (counted_) return;
    order_.resize(ids.size());
    std::iota(order_.begin(), order_.end(), 0);
    std::stable_sort(order_.begin(), order_.end(),
                     [&](std::int32_t a, std::int32_t b) { return id(a) < id(b); });
  }
  /// The first sample of this id, or -1.
  std::int32_t index_of(std::int64_t wanted) const {
    if (ids_.empty()) return -1;
    if (counted_) {
      const bool there = wanted >= ids_.front() && wanted <= ids_.back();
      return there ? static_cast<std::int32_t>(wanted - ids_.front()) : -1;
    }
    const auto at = std::lower_bound(order_.begin(), order_.end(), wanted,
                                     [&](std::int32_t i, std::int64_t value) { return id(i) < value; });
    return at != order_.end() && id(*at) == wanted ? *at : -1;
  }
  std::vector<std::int64_t> repeated() const {
    std::vector<std::int64_t> out;
    for (std::size_t i = 1; i < order_.size(); ++i)
      if (id(order_[i]) == id(order_[i - 1])) out.push_back(id(order_[i]));
    return out;
  }

 private:
  std::int64_t id(std::int32_t i) const { return ids_[static_cast<std::size_t>(i)]; }
  const std::vector<std::int64_t>& ids_;
  bool counted_ = true;
  std::vector<std::int32_t> order_;
};

SampleTree::Sample sample_of(std::string_view line, const PieceReader& reader, std::size_t read) {
  const auto so_far = [&] { return std::to_string(read) + " samples were read before it"; };
  Words words(line);
  std::array<std::string_view, 7> cells;
  for (std::size_t i = 0; i < cells.size(); ++i) {
    cells[i] = words.next();
    if (!cells[i].empty()) continue;
    const std::string end = reader.stopped() ? "" : "the file ends within it: ";
    reader.refuse_line(end + "it has " + std::to_string(i) + " of the 7 columns id type x y z radius parent",
                       so_far());
  }
  SampleTree::Sample sample;
  sample.line = static_cast<std::int64_t>(reader.line_number());
  for (const std::size_t i : {std::size_t{0}, std::size_t{6}}) {
    const auto value = number<std::int64_t>(cells[i]);
    if (!value)
      reader.refuse_line(std::string(column_names[i]) + " " + shown(cells[i]) + " is no whole number",
                         so_far());
    (i == 0 ? sample.id : sample.parent) = *value;
  }
  std::array<double, 4> values{};
  for (std::size_t i = 0; i < 4; ++i) {
    const auto value = number_or_nan(cells[i + 2]);
    if (!value)
      reader.refuse_line(std::string(column_names[i + 2]) + " " + shown(cells[i + 2]) + " is no number",
                         so_far());
    values[i] = *value;
  }
  sample.place = Vec3(values[0], values[1], values[2]);
  sample.radius = values[3];
  return sample;
}

/// Lines one after the other, as SWC itself would have them.
bool counted_up(const std::vector<std::int64_t>& references) {
  return std::adjacent_find(references.begin(), references.end(), [](std::int64_t a, std::int64_t b) {
           return b <= a || b != a + 1;
         }) == references.end();
}

}  // namespace

void SampleTree::add(const Sample& sample) {
  ids_.push_back(sample.id);
  parents_.push_back(sample.parent);
  points_.push_back(sample.place);
  radii_.push_back(sample.radius);
  lines_.push_back(sample.line);
}

LoadedGraph SampleTree::graph() {
  LoadedGraph loaded;
  loaded.reference_name = "line";
  const IdTable table(ids_);
  loaded.graph.edges.reserve(ids_.size());
  loaded.graph.references.reserve(ids_.size());
  for (std::size_t i = 0; i < ids_.size(); ++i) {
    if (parents_[i] == -1) continue;
    const std::int32_t parent = table.index_of(parents_[i]);
    const double radius = parent >= 0 ? radii_[static_cast<std::size_t>(parent)] : radii_[i];
    loaded.graph.edges.push_back({parent, static_cast<std::int32_t>(i), radius, radii_[i]});
    loaded.graph.references.push_back(lines_[i]);
  }
  const std::vector<std::int64_t> repeated = table.repeated();
  if (!repeated.empty())
    loaded.warnings.push_back(std::to_string(repeated.size()) + " samples repeat the id of another (first: " +
                              std::to_string(repeated.front()) +
                              "); where it is a parent, the first one is meant");
  loaded.graph.points = std::move(points_);
  return loaded;
}

LoadedGraph read_graph_swc(const fs::path& path, const core::TaskContext& task) {
  PieceReader reader(path, task);
  SampleTree tree;
  std::string_view line;
  while (reader.line(line)) {
    if (reader.line_number() == 1) line = without_byte_order_mark(line);
    const std::size_t first = line.find_first_not_of(" \t");
    if (first == std::string_view::npos || line[first] == '#') continue;
    tree.add(sample_of(line, reader, tree.size()));
  }
  LoadedGraph loaded = tree.graph();
  warn_if_cut(reader, loaded);
  return loaded;
}

std::vector<std::string> write_graph_swc(const fs::path& path, VesselGraph graph,
                                         const core::TaskContext& task) {
  const std::size_t points = graph.points.size();
  geometry::put_in_order(graph);  // readers want parents before their children
  std::vector<std::string> warnings;
  if (graph.points.size() < points)
    warnings.push_back(std::to_string(points - graph.points.size()) +
                       " points of no segment were left out: an SWC sample would be a root");
  if (!counted_up(graph.references))
    warnings.push_back("SWC has no place for the segments' references; .vtp and .csv keep them");
  std::vector<std::int32_t> arriving(graph.points.size(), -1);
  std::vector<double> radius(graph.points.size(), -1.0);
  for (std::size_t e = 0; e < graph.edges.size(); ++e) {
    const GraphEdge& edge = graph.edges[e];
    std::int32_t& parent = arriving[static_cast<std::size_t>(edge.to)];
    if (parent >= 0 || edge.to <= edge.from)
      throw InvalidInput("cannot write " + path.string() +
                         ": SWC holds trees alone, and the network has points with several parents or "
                         "segments in a circle; write .vtp or .csv");
    parent = edge.from;
    radius[static_cast<std::size_t>(edge.to)] = edge.radius_to;
  }
  std::size_t jumps = 0;
  for (const GraphEdge& edge : graph.edges) {
    double& r = radius[static_cast<std::size_t>(edge.from)];
    if (arriving[static_cast<std::size_t>(edge.from)] < 0 && r < 0.0) r = edge.radius_from;
    jumps += r != edge.radius_from && !(std::isnan(r) && std::isnan(edge.radius_from));
  }
  if (jumps > 0)
    warnings.push_back(std::to_string(jumps) +
                       " segments begin with another radius than the one before them ends with; SWC has one "
                       "radius for a point, and these begin with their parent's now");
  TextWriter out(path, task);
  out.text("# id type x y z radius parent; type 0: undefined\n");
  for (std::size_t i = 0; i < graph.points.size(); ++i) {
    const Vec3& p = graph.points[i];
    out.whole(static_cast<std::int64_t>(i) + 1);
    out.text(" 0");
    for (const double x : {p.x(), p.y(), p.z(), radius[i]}) out.number(' ', x);
    out.text(" ");
    out.whole(arriving[i] < 0 ? -1 : static_cast<std::int64_t>(arriving[i]) + 1);
    out.text("\n");
  }
  out.commit();
  return warnings;
}

}  // namespace ostia::io
