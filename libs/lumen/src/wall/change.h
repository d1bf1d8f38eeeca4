#pragma once
// What of a wall has to be asked again after its field has changed.

#include "wall/block.h"
#include "wall/job.h"

namespace ostia::lumen {

/// Forgets what blocks know in a box where the field has changed, and all that was made of it.
///
/// tolerance 0: everything in the box. Above 0: the field is asked at one point in four of the wall that is
/// there, and bricks of 4^3 cells in which it is nowhere farther from zero than the tolerance stay as they
/// are. The wall is compared with the field as it is now, not with the last change, so that small changes do
/// not add up over many edits. A node is forgotten by all blocks that hold it or by none, so that neighbours
/// go on seeing the same values.
void forget_changed(WallJob& job, WallBlocks& blocks, const Box3& box, double tolerance);

}  // namespace ostia::lumen
