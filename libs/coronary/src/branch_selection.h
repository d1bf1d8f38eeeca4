#pragma once
/// \file Which ways of a front through the vessels are branches of the tree, and which are dismissed.

#include "tube_front.h"
#include "vein_stretch.h"

#include "ostia/coronary/tree_growth.h"
#include "ostia/imaging/volume.h"

#include <cstdint>
#include <optional>
#include <unordered_set>
#include <vector>

namespace ostia::coronary {

/// Branches taken off the ways of a front, the longest first. `tube` and `radius_mm` have the likeness to a
/// tube and the calibre at each voxel; voxels of `unseen` bridge a gap. A way is dismissed that is shorter
/// than `least_branch_mm` beyond the lumen that it leaves (of a clear tube: from the middle of it), and one
/// that runs into a vein, where `veins` says how they look.
std::vector<GrownBranch> branches_on(const FrontNodes& nodes, const imaging::FloatVolume& tube,
                                     const imaging::FloatVolume& radius_mm,
                                     const std::unordered_set<std::int64_t>& unseen, double least_branch_mm,
                                     const std::optional<VeinLook>& veins = std::nullopt);

}  // namespace ostia::coronary
