#include "ostia/core/error.h"
#include "ostia/evaluation/centerline_scores.h"

#include <algorithm>
#include <unordered_map>

namespace ostia::evaluation {
namespace {

using geometry::TreeSegment;
using geometry::Vessel;
using geometry::VesselTree;
using Segments = std::vector<std::int32_t>;

/// From a root down to a node, along each node's first parent.
Segments path_to(std::int32_t node, const VesselTree& tree,
                 const std::unordered_map<std::int32_t, std::size_t>& parent) {
  Segments path;
  for (auto above = parent.find(node); above != parent.end(); above = parent.find(node)) {
    const TreeSegment& segment = tree.segments[above->second];
    path.push_back(segment.id);
    node = segment.from;
    if (path.size() > tree.segments.size()) throw InvalidInput("the centerlines form a loop; give a tree");
  }
  std::reverse(path.begin(), path.end());
  return path;
}

}  // namespace

std::vector<NamedLine> lines_of(const VesselTree& tree) {
  std::unordered_map<std::int32_t, std::size_t> parent;
  for (std::size_t i = 0; i < tree.segments.size(); ++i) parent.try_emplace(tree.segments[i].to, i);
  std::vector<Vessel> paths;
  for (const std::int32_t end : geometry::ends(tree)) {
    Vessel path{end, "end " + std::to_string(end), path_to(end, tree, parent)};
    if (path.segments.empty()) continue;
    for (const Vessel& vessel : tree.vessels)
      if (!vessel.name.empty() && !vessel.segments.empty() && vessel.segments.back() == path.segments.back())
        path.name = vessel.name;
    paths.push_back(std::move(path));
  }
  const std::size_t ends = paths.size();
  for (const Vessel& vessel : tree.vessels) {
    const auto same = [&](const Vessel& path) { return path.segments == vessel.segments; };
    if (vessel.segments.empty() ||
        std::any_of(paths.begin(), paths.begin() + static_cast<std::ptrdiff_t>(ends), same))
      continue;
    paths.push_back(vessel);
    if (vessel.name.empty()) paths.back().name = "vessel " + std::to_string(vessel.id);
  }
  std::vector<NamedLine> lines;
  for (const Vessel& path : paths) lines.push_back({path.name, geometry::vessel_axis(tree, path).points});
  return lines;
}

}  // namespace ostia::evaluation
