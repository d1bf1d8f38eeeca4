#pragma once
/// \file Trees put together of parts.

#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <functional>

namespace ostia::geometry {

/// Adds a part that has ids of its own: its nodes, segments and vessels are numbered on from those of the
/// tree, from `least_id` on in an empty one. `vessel_id`, where given, says what a vessel of the part is
/// called by its old id. Names stay. Throws nothing of its own.
void append_tree(VesselTree& tree, VesselTree part, std::int32_t least_id = 0,
                 const std::function<std::int32_t(std::int32_t)>& vessel_id = {});

}  // namespace ostia::geometry
