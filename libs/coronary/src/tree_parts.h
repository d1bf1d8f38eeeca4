#pragma once
/// \file A tree put together of parts.

#include "ostia/geometry/vessel_tree.h"

#include <cstdint>
#include <functional>

namespace ostia::coronary {

/// Nodes and segments of the part are numbered on from those of the tree; `id_of` gives the new id of each of
/// the part's vessels by its old one.
void append_part(geometry::VesselTree& tree, const geometry::VesselTree& part,
                 const std::function<std::int32_t(std::int32_t)>& id_of);

}  // namespace ostia::coronary
