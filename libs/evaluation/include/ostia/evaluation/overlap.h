#pragma once
/// \file Overlap of masks.

#include "ostia/imaging/volume.h"

#include <functional>

namespace ostia::evaluation {

/// 2 |A and B| / (|A| + |B|) of the nonzero voxels whose centres `counts` (all when empty). Throws
/// InvalidInput when the grids differ or both masks are empty there.
double dice(const imaging::MaskVolume& a, const imaging::MaskVolume& b,
            const std::function<bool(const imaging::Vec3&)>& counts = {});

/// Voxels of a grid whose centres a level set (negative inside, trilinear between its own voxels) holds.
/// Outside the level set's grid nothing is inside.
imaging::MaskVolume mask_of(const imaging::FloatVolume& level_set, const imaging::Geometry& grid);

}  // namespace ostia::evaluation
