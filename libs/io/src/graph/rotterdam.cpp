// Lines of the Rotterdam challenge as networks.

#include "graph/formats.h"

#include "ostia/io/rotterdam_file.h"

#include <limits>

namespace ostia::io {

LoadedGraph read_graph_rotterdam(const std::filesystem::path& path) {
  const RotterdamReference line = read_rotterdam_axis(path);
  LoadedGraph loaded;
  loaded.reference_name = "point";
  const RotterdamReference apart = without_repeated(line);
  if (const std::size_t repeated = line.points.size() - apart.points.size(); repeated > 0)
    loaded.warnings.push_back(std::to_string(repeated) + " points that repeat the one before are left out");
  if (apart.radius.empty())
    loaded.warnings.push_back("it has no radius: its columns are x y z; the fourth is a radius");
  const auto radius = [&](std::size_t i) {
    return apart.radius.empty() ? std::numeric_limits<double>::quiet_NaN() : apart.radius[i];
  };
  loaded.graph.points = apart.points;
  for (std::size_t i = 1; i < apart.points.size(); ++i) {
    loaded.graph.edges.push_back(
        {static_cast<std::int32_t>(i - 1), static_cast<std::int32_t>(i), radius(i - 1), radius(i)});
    loaded.graph.references.push_back(static_cast<std::int64_t>(i));
  }
  return loaded;
}

}  // namespace ostia::io
