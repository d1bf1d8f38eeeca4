#pragma once
/// \file Masks whose rim is noise: how rough one is, and the rim made smooth.

#include "ostia/core/task_context.h"
#include "ostia/imaging/volume.h"

namespace ostia::coronary {

/// Pits (voxels outside with four and more of their six neighbours inside) over the voxels of the rim. Stairs
/// of a mask that a hand or a network drew have up to 0.03; a rim of which a quarter was flipped at random
/// has 0.15; 0 for an empty mask.
double rim_roughness(const imaging::MaskVolume& mask);

/// Makes a rim smooth that is rougher than stairs are; others stay as they are, bit for bit. A voxel belongs
/// to the object by its share of the brightest place about it in the blurred mask, so that thin vessels stay
/// and do not shrink: as many voxels as before are inside. Labels are those of the nearest voxels. Returns
/// whether it did. Deterministic. Throws Cancelled.
bool smooth_rough_rim(imaging::MaskVolume& mask, const core::TaskContext& task = core::no_task());

}  // namespace ostia::coronary
