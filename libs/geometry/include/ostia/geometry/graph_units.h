#pragma once
/// \file Whether the places and the radii of a network of vessels can be in one unit.

#include "ostia/geometry/graph_faults.h"

#include <string>

namespace ostia::geometry {

/// A sentence with the way out where the branches are shorter on average than the least radius, as they are
/// where a file gives places in metres and radii in millimetres. Empty: nothing is wrong.
std::string unit_doubt(const GraphFacts& facts);

}  // namespace ostia::geometry
