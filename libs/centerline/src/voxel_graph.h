#pragma once
/// \file The voxels of a skeleton with their neighbours, and clusters of those where lines meet.

#include "ostia/centerline/thinning.h"

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

namespace ostia::centerline::detail {

using Cell = std::array<std::int64_t, 3>;

struct SkeletonVoxels {
  std::vector<Cell> cells;
  std::vector<std::vector<std::int32_t>> neighbours;  // ascending
  std::size_t degree(std::int32_t v) const { return neighbours[static_cast<std::size_t>(v)].size(); }
};

// Throws InvalidInput where a voxel could be removed.
SkeletonVoxels neighbours_of(const Thinned& skeleton);

// A connected set of voxels with three neighbours or more.
struct Cluster {
  std::vector<std::int32_t> voxels;  // ascending
  // Lines between voxels that span the cluster and its loops; none where it holds no loop.
  std::vector<std::pair<std::int32_t, std::int32_t>> lines;
};

// `cluster_of` gets one entry a voxel, -1 for those of lines. Throws GeometryError for a closed surface.
std::vector<Cluster> clusters_of(const SkeletonVoxels& skeleton, std::vector<std::int32_t>& cluster_of);

}  // namespace ostia::centerline::detail
