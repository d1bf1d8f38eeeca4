#include "tree_parts.h"

#include <utility>

namespace ostia::coronary {

void append_part(geometry::VesselTree& tree, const geometry::VesselTree& part,
                 const std::function<std::int32_t(std::int32_t)>& id_of) {
  const auto node = static_cast<std::int32_t>(tree.nodes.size()) + 1;
  const auto segment = static_cast<std::int32_t>(tree.segments.size()) + 1;
  for (geometry::TreeNode one : part.nodes) {
    one.id += node;
    tree.nodes.push_back(one);
  }
  for (geometry::TreeSegment one : part.segments) {
    one.id += segment;
    one.from += node;
    one.to += node;
    tree.segments.push_back(std::move(one));
  }
  for (geometry::Vessel one : part.vessels) {
    one.id = id_of(one.id);
    for (std::int32_t& id : one.segments) id += segment;
    tree.vessels.push_back(std::move(one));
  }
}

}  // namespace ostia::coronary
