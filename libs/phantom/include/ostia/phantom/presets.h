#pragma once
/// \file The grids that synthetic scans come on.

#include "ostia/imaging/volume.h"
#include "ostia/phantom/coronary_tree.h"
#include "ostia/phantom/heart.h"

namespace ostia::phantom {

/// - full: 512 x 512 x 300 voxels of 0.35 x 0.35 x 0.45 mm: the whole heart and root, and what is around
/// them;
/// - small: the same field at 0.7 x 0.7 x 0.9 mm;
/// - tiny: 96 x 96 x 80 voxels of 0.5 x 0.5 x 0.6 mm about both ostia, the left main and the proximal
///   arteries; it compresses to less than 1 MB.
enum class Preset { tiny, small, full };

/// The grid, with the axes of the world. `full` and `small` hold the whole tree (5 mm clear of the border)
/// and the root, with the heart in their middle as far as that allows; `tiny` is centred on what lies within
/// 25 mm of vessel from an ostium, or less where 48 mm do not hold so much. Without a tree (null) the heart
/// and root alone decide. Throws InvalidInput where a tree is larger than the field.
imaging::Geometry grid_of(Preset preset, const HeartShape& heart, const CoronaryTree* tree = nullptr);

}  // namespace ostia::phantom
