#pragma once
/// \file How wide and of what shape a mask's vessels are, ring by ring.

#include "mask/mask_vessels.h"

#include "ostia/pipeline/mask_walls.h"

#include <vector>

namespace ostia::pipeline {

/// The wall of the blurred mask as seen from a place of the axis; not known where the place is not inside it,
/// or too many rays end nowhere. Rays that leave through a branch are as long as the median.
struct SeenRing {
  MaskRing radius{};
  double median = 0.0;
  bool known = false;
};
std::vector<SeenRing> seen_rings(const MaskVessel& vessel, const imaging::FloatVolume& inside);

void take_shapes(MaskVessel& vessel, const std::vector<SeenRing>& seen, const MaskWallOptions& options);

/// Areas that hold the volume of the voxels that are no farther beyond a wall than `most_beyond_mm`, evened
/// along each vessel.
void take_areas(std::vector<MaskVessel>& vessels, const std::vector<std::vector<SeenRing>>& seen,
                const imaging::MaskVolume& mask, const std::vector<std::int64_t>& voxels,
                double most_beyond_mm, const MaskWallOptions& options, const core::TaskContext& task);

}  // namespace ostia::pipeline
