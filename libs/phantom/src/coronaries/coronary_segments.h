#pragma once
/// \file The standard segments of a vessel, by where its branches leave.

#include "ostia/phantom/coronary_tree.h"

namespace ostia::phantom {

/// Sets the vessel's segments from its name and its branches' in the tree; none for a name that has none.
void add_segments(CoronaryVessel& vessel, const CoronaryTree& tree, Dominance dominance);

}  // namespace ostia::phantom
