#pragma once
/// \file Arrival times of wave fronts in an image (Sethian 1996; [Antiga] eq. 2), on the voxels they reach
/// alone.

#include "block_grid.h"

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"
#include "ostia/segmentation/intensity_range.h"

#include <cstdint>
#include <limits>
#include <vector>

namespace ostia::segmentation::detail {

/// Speed of a front from the intensity: 0 outside the range, else a ramp from `slowest` at the lower bound to
/// 1 at the lumen's.
struct SpeedModel {
  IntensityRange range;
  double lumen_hu = 0.0;
  double slowest = 0.05;

  float operator()(std::int16_t hu) const;
};

inline constexpr float kUnreached = std::numeric_limits<float>::infinity();

/// A voxel waiting in the narrow band. Ties go to the lower voxel, so the order does not depend on the heap's
/// history.
struct Trial {
  float time;
  Voxel voxel;
  bool operator>(const Trial& other) const {
    if (time != other.time) return time > other.time;
    return voxel > other.voxel;
  }
};

/// Where a front has been: final arrival times (mm at speed 1), and the voxels in the order of their arrival.
struct FrontTimes {
  BlockGrid<float> times;
  std::vector<Voxel> order;
  float target_time = kUnreached;  ///< at the target reached first
};

struct FrontStop {
  std::vector<Voxel> targets;
  bool all_voxels = false;  ///< go on until nothing is left
  double overrun = 0.15;    ///< relative to the time at the first target
  double overrun_mm = 0.0;  ///< and in addition
};

/// A front from `sources` (in-range voxels nearest to the world points, which start it at their true
/// distance). Second-order upwind differences in the spacing of each axis where two settled neighbours allow
/// it, else first-order.
FrontTimes march(const imaging::ImageVolume& image, const std::vector<Vec3>& sources_mm,
                 const SpeedModel& speed, const FrontStop& stop, const core::TaskContext& task);

/// Nearest voxel, which must exist.
Voxel nearest_voxel(const imaging::Geometry& geometry, const Vec3& world_mm);
inline bool inside(const std::array<std::int64_t, 3>& size, const Voxel& v) {
  for (int d = 0; d < 3; ++d) {
    if (v[d] < 0 || v[d] >= size[d]) return false;
  }
  return true;
}

}  // namespace ostia::segmentation::detail
