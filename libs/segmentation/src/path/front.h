#pragma once
/// \file A front from one place until it meets a target, and the way back down its arrival times.

#include "path/speed.h"

#include "ostia/core/task_context.h"

#include <functional>
#include <vector>

namespace ostia::segmentation::detail {

struct PathFrontStop {
  std::function<bool(const Voxel&)> target;
  std::function<bool(const Voxel&)> within;  ///< where the front may go; everywhere where it is empty
  double max_length_mm = 250.0;
  std::int64_t most_voxels = 0;
};

enum class PathFrontEnd { target, length, voxels, exhausted };

struct PathFront {
  BlockGrid<float> times;  ///< of settled voxels, else infinite
  Voxel reached{};         ///< the target
  PathFrontEnd end = PathFrontEnd::exhausted;
  std::int64_t visited = 0;
  double length_mm = 0.0;  ///< of the cheapest way to the voxel settled last
};

/// First-order upwind fast marching in the spacing of each axis (Sethian 1996), and with it the length of the
/// cheapest way (Deschamps and Cohen 2001): grad T . grad L = |grad T|. A front whose cheapest unfinished
/// way is longer than the limit gives up.
PathFront run_front(TubeSpeed& speed, const Vec3& from_mm, const PathFrontStop& stop,
                    const core::TaskContext& task);

/// From the target down the gradient of the arrival times to the source: points in world coordinates, steps
/// of a third of the least spacing.
std::vector<Vec3> trace_back(const imaging::Geometry& geometry, const PathFront& front,
                             const Vec3& source_mm);

}  // namespace ostia::segmentation::detail
