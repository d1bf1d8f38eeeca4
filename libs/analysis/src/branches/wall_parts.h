#pragma once
/// \file A wall cut into the parts of its branches.

#include "branches/branch_tubes.h"

#include "ostia/analysis/branch_mapping.h"

#include <vector>

namespace ostia::analysis {

struct WallPart {
  std::int32_t group = 0;
  geometry::TriMesh mesh;
  std::vector<WallPoint> sources;
};

/// Each point belongs to the branch in whose tube it lies deepest; triangles between two branches are cut
/// where both tubes are equally deep, those between three at a point within. Parts come by group.
std::vector<WallPart> wall_parts(const geometry::TriMesh& wall, const BranchTubes& tubes);

}  // namespace ostia::analysis
