#pragma once
/// \file The rings where a thin branch leaves a wide vessel that goes on: a disc on the vessel's wall.

#include "joint_rings.h"

#include <optional>

namespace ostia::reconstruction {

/// The thin branch's ring lies on the wall around the place where it leaves, well wider than itself; the two
/// others share half of it each, and an arc behind. None unless there are three branches, one of them less
/// than 0.3 as wide as the two others, which make more than 100 degrees with each other.
std::optional<JointRings> about_thin_branch(const std::vector<Slot>& slots, int sides,
                                            const JointSurface& surface);

}  // namespace ostia::reconstruction
