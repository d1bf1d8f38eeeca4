#pragma once
/// \file Where atherosclerosis narrows a coronary tree.

#include "ostia/phantom/coronary_tree.h"

#include <cstdint>

namespace ostia::phantom {

/// About 2 to 6 lesions and some specks of calcium, times `amount`, mostly in the proximal thirds of the
/// three main vessels and of large side branches, clear of bifurcations and of each other.
void draw_disease(CoronaryTree& tree, double amount, std::uint64_t seed);

/// Whether a lesion may lie there: clear of the vessel's ends, of bifurcations and of other lesions.
bool free_for_lesion(const CoronaryTree& tree, const CoronaryVessel& vessel, double from_mm, double to_mm);

}  // namespace ostia::phantom
