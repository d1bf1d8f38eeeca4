#pragma once
/// \file Parts of a mask joined to the tree that they belong to.

#include "line_graph.h"

#include "ostia/coronary/mask_tree.h"

#include <cstdint>
#include <vector>

namespace ostia::coronary {

/// Parts that no root is in are joined to those that have one (or were joined themselves), the likeliest
/// bridge first, while it is likely enough. Bridges run from an end of the part to an end of a line, or to
/// its side.
std::vector<MaskBridge> bridge_gaps(LineGraph& graph, const std::vector<std::int32_t>& roots,
                                    const MaskTreeOptions& options);

}  // namespace ostia::coronary
