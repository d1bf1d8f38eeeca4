#pragma once
/// \file Walls about carried axes: the image's, and the former ones where the image is unclear.

#include "follow_up/carry_axes.h"

#include "ostia/analysis/lumen_profile.h"
#include "ostia/lumen/start_surface.h"

#include <vector>

namespace ostia::session {

/// One wall a vessel of the carried tree, in its order; what is told of each goes into its line.
/// `surface_of`: of the former model, asked from the calling thread. Throws Cancelled.
std::vector<lumen::RadialWall> carried_walls(const lumen::LumenModel& before,
                                             const analysis::SurfaceOfVessel& surface_of,
                                             CarriedTree& carried, const imaging::ImageVolume& image,
                                             const analysis::PointMap& map, const core::TaskContext& task);

}  // namespace ostia::session
