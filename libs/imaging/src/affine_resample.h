#pragma once
/// \file Resampling of voxels that lie on any affine grid, sheared ones included.

#include "ostia/imaging/sampling.h"

#include <array>
#include <cstdint>

namespace ostia::imaging {

/// What to give where the input has no voxel.
enum class Beyond { outside_value, border_value };

/// Fills `out.voxels` (resized to its geometry): the voxel with index x takes the input's value at index
/// `linear` x + `offset`. `voxels` has `size` voxels, x fastest. Defined for int16, uint8 and float.
template <class T>
void affine_resample(const T* voxels, const std::array<std::int64_t, 3>& size, const Mat3& linear,
                     const Vec3& offset, Interpolation how, Beyond beyond, T outside, Volume<T>& out,
                     const core::TaskContext& task);

}  // namespace ostia::imaging
