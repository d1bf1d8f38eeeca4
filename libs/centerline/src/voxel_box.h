#pragma once
/// \file The box of an object's voxels with a border of background, on which thinning works.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace ostia::centerline::detail {

struct VoxelBox {
  std::array<std::int64_t, 3> size{0, 0, 0};   // border of one voxel on all sides included
  std::array<std::int64_t, 3> lower{0, 0, 0};  // voxel of the image at the box's (1, 1, 1)
  std::array<std::int64_t, 3> stride{1, 0, 0};
  std::vector<std::uint8_t> object;   // 1 object
  std::vector<std::uint32_t> voxels;  // of the object, ascending
  std::int64_t image_offset(std::uint32_t at, const imaging::Geometry& grid) const;
};

// Throws InvalidInput and ResourceError as `thinned` does. No voxels: an image without object.
VoxelBox box_of(const imaging::MaskVolume& mask);

// Makes cavities object; returns how many voxels.
std::int64_t fill_cavities(VoxelBox& box);

// Squared Euclidean distances to the nearest background voxel in mm^2, at the object's voxels alone (other
// places are not initialised): exact, by lower envelopes of parabolas one axis after another (P. F.
// Felzenszwalb and D. P. Huttenlocher, Theory Comput. 8:415-428, 2012), within the object's runs.
std::unique_ptr<float[]> squared_distances(const VoxelBox& box, const imaging::Vec3& spacing,
                                           const core::TaskContext& task);

}  // namespace ostia::centerline::detail
