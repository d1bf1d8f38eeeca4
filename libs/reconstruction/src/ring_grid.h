#pragma once
/// \file The rings of a reconstructed surface, read off the order of its quadrilaterals.

#include "ostia/reconstruction/surface.h"

#include <cstdint>
#include <vector>

namespace ostia::reconstruction {

/// Of one branch, from its proximal to its distal end: rings of sides * 2^level points, counter-clockwise
/// about its direction. Every 2^level-th point and ring is one of level 0.
using RingGrid = std::vector<std::vector<std::int32_t>>;

/// By branch. Throws GeometryError where the quadrilaterals are not in the order that ReconstructedSurface
/// tells.
std::vector<RingGrid> ring_grids(const ReconstructedSurface& surface);

}  // namespace ostia::reconstruction
