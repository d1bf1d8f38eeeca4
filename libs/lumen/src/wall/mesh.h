#pragma once
// The blocks' parts of a wall as one surface.

#include "wall/block.h"

namespace ostia::lumen {

/// Points are shared, first by block, then by piece and edge. For blocks between two calls, whose pieces have
/// their `first_point`. Throws ResourceError for more points than an index can name.
geometry::TriMesh joined(const WallBlocks& blocks);

}  // namespace ostia::lumen
