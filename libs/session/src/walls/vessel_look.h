#pragma once
/// \file What an image shows of a vessel, of a lumen that was measured once for all of it.

#include "walls/lumen_on_rays.h"

#include "ostia/session/evaluability.h"
#include "ostia/session/outer_walls.h"

#include <optional>

namespace ostia::session {

constexpr int rays_around = 32;  // of a row, where it is asked how far a vessel can be judged

/// As vessel_evaluability, whose step the rows have, with `rays_around` rays.
VesselEvaluability evaluability_in(const OwnLumen& own, const lumen::LumenModel& model,
                                   const imaging::ImageVolume& image, double noise_hu,
                                   const VesselEvaluabilityOptions& options, const core::TaskContext& task);

/// As vessel_walls, whose step and rays the rows have.
std::optional<VesselWalls> walls_in(const OwnLumen& own, const lumen::LumenModel& model,
                                    const imaging::ImageVolume& image, const OuterWallsOptions& options,
                                    const core::TaskContext& task);

}  // namespace ostia::session
