#pragma once
/// \file A vessel's way through its tree, in abscissas of its axis.

#include "ostia/lumen/lumen_model.h"

#include <cstdint>
#include <vector>

namespace ostia::analysis {

const geometry::Vessel& path_of(const geometry::VesselTree& tree,
                                std::int32_t vessel);  ///< throws InvalidInput
/// The first vessel, in the tree's order, that passes through a segment. Throws InvalidInput where none does.
const geometry::Vessel& owner_of_segment(const geometry::VesselTree& tree, std::int32_t segment);

/// Where another segment leaves a vessel.
struct Leaving {
  double s_mm = 0.0;
  std::int32_t segment = 0;
  std::size_t behind = 0;  ///< how many of the vessel's segments lie before it
};
/// In the order of the vessel, then of the tree's segments.
std::vector<Leaving> leaving_branches(const lumen::LumenModel& model, std::int32_t vessel);

}  // namespace ostia::analysis
