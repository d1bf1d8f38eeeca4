#pragma once
/// \file A front through voxels that look like tubes, and the cheapest ways along which it came.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <unordered_map>
#include <vector>

namespace ostia::coronary {

struct FrontSource {
  std::int64_t voxel = 0;  ///< offset in the grid
  std::size_t of = 0;      ///< which ostium
};

struct FrontNode {
  std::int64_t before = -1;  ///< offset of the voxel it came from; -1 for a source
  float cost = 0.0F;         ///< mm at full speed
  float length_mm = 0.0F;    ///< of the cheapest way
  std::int32_t of = 0;       ///< source
  bool settled = false;
};

using FrontNodes = std::unordered_map<std::int64_t, FrontNode>;

/// `tube` is the share of the contrast with which each voxel looks like a tube; the front enters voxels of at
/// least `least` (sources in any case) at the speed of its square. Cheapest ways over 26 neighbours in
/// millimetres (Dijkstra 1959); ties go to the lower voxel.
FrontNodes run_tube_front(const imaging::FloatVolume& tube, const std::vector<FrontSource>& sources,
                          double least, const core::TaskContext& task);

}  // namespace ostia::coronary
