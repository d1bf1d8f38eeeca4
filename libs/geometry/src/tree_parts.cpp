#include "ostia/geometry/tree_parts.h"

#include <algorithm>
#include <utility>

namespace ostia::geometry {

void append_tree(VesselTree& tree, VesselTree part, std::int32_t least_id,
                 const std::function<std::int32_t(std::int32_t)>& vessel_id) {
  const auto after = [least_id](const auto& list) {
    std::int32_t next = least_id;
    for (const auto& one : list) next = std::max(next, one.id + 1);
    return next;
  };
  const std::int32_t nodes = after(tree.nodes), segments = after(tree.segments),
                     vessels = after(tree.vessels);
  for (TreeNode& node : part.nodes) {
    node.id += nodes;
    tree.nodes.push_back(node);
  }
  for (TreeSegment& segment : part.segments) {
    segment.id += segments;
    segment.from += nodes;
    segment.to += nodes;
    tree.segments.push_back(std::move(segment));
  }
  for (Vessel& vessel : part.vessels) {
    vessel.id = vessel_id ? vessel_id(vessel.id) : vessel.id + vessels;
    for (std::int32_t& id : vessel.segments) id += segments;
    tree.vessels.push_back(std::move(vessel));
  }
}

}  // namespace ostia::geometry
