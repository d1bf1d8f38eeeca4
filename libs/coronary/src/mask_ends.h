#pragma once
/// \file Ends of a mask's vessels that a plane across the axis can cut.

#include "mask_axes.h"

#include "ostia/coronary/mask_tree.h"

#include <vector>

namespace ostia::coronary {

/// An end is clean where a plane a little inside it meets no vessel but its own, and its dome neither.
/// Stubs that have no such place are left out, the shortest first; ends that touch another vessel are
/// shortened to their nearest clean place; a vessel whose first branch leaves right at its ostium begins a
/// little earlier. An end that touches a vessel far along the tree, and whose next clean place would cost too
/// much, stays: its wall is parted from the other. Vessels are numbered anew.
std::vector<MaskEndChange> settle_ends(MaskAxes& axes);

}  // namespace ostia::coronary
