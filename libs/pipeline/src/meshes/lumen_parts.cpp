#include "ostia/geometry/mesh_topology.h"
#include "ostia/pipeline/lumen_axes.h"

#include <algorithm>
#include <cstdint>
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

}  // namespace ostia::pipeline
