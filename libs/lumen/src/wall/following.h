#pragma once
// Following the wall from cell to cell within one block.

#include "wall/block.h"
#include "wall/job.h"

#include <vector>

namespace ostia::lumen {

/// Follows the wall in a block from the cells of its seeds (ascending, each once) and from cells that the
/// wall enters by; returns cells by which it goes on into other blocks. Other blocks' `kept` values on shared
/// faces are used; what is found depends on the field alone, not on the order of the entries.
std::vector<GridIndex> follow_wall(WallJob& job, WallBlock& block, const WallBlocks& all,
                                   const std::vector<CellCode>& seeds, const std::vector<GridIndex>& entries);

}  // namespace ostia::lumen
