#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"

#include <algorithm>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::pipeline {

using geometry::TriMesh;

std::vector<TriMesh> parts_of(const TriMesh& mesh) {
  const std::vector<std::int32_t> part = geometry::components(mesh);
  const std::int32_t count = part.empty() ? 0 : *std::ranges::max_element(part) + 1;
  if (count == 1) return {mesh};
  std::vector<TriMesh> parts;
  for (std::int32_t k = 0; k < count; ++k) {
    std::vector<bool> keep;
    for (const std::int32_t p : part) keep.push_back(p == k);
    parts.push_back(geometry::subset(mesh, keep));
  }
  return parts;
}

void append_tree(geometry::VesselTree& tree, geometry::VesselTree other) {
  const auto after = [](const auto& list) {
    std::int32_t next = 0;
    for (const auto& one : list) next = std::max(next, one.id + 1);
    return next;
  };
  const std::int32_t nodes = after(tree.nodes), segments = after(tree.segments),
                     vessels = after(tree.vessels);
  for (geometry::TreeNode& node : other.nodes) {
    node.id += nodes;
    tree.nodes.push_back(node);
  }
  for (geometry::TreeSegment& segment : other.segments) {
    segment.id += segments;
    segment.from += nodes;
    segment.to += nodes;
    tree.segments.push_back(std::move(segment));
  }
  for (geometry::Vessel& vessel : other.vessels) {
    vessel.id += vessels;
    for (std::int32_t& id : vessel.segments) id += segments;
    tree.vessels.push_back(std::move(vessel));
  }
}

}  // namespace ostia::pipeline
