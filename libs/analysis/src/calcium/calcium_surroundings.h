#pragma once
/// \file What lies about a bright part in its slice.

#include "calcium/calcium_spots.h"

namespace ostia::analysis {

/// Where each part of the image is, [0] of nothing; upper bounds are exclusive.
std::vector<imaging::Region> part_boxes(const CalciumSpots& found, const imaging::Geometry& grid);

/// Of the ring from 2.5 to 6 mm about the part, without other bright parts, in the middle one of its slices:
/// the share above 100 HU, which cartilage, bone and organs in noise have.
double bright_surroundings(const CalciumSlices& slices, const CalciumSpots& found, std::uint32_t part,
                           const imaging::Region& box);

}  // namespace ostia::analysis
