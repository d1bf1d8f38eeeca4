#pragma once
/// \file How far the walls of a tree of pressures may be off, by the image that they were drawn on
/// (docs/methods/pressure-uncertainty.md).

#include "ostia/analysis/wall_spread.h"
#include "ostia/hemodynamics/uncertainty.h"
#include "ostia/imaging/volume.h"
#include "ostia/session/pressure_tree.h"

namespace ostia::session {

/// `given` with a spread for each station of the branches: at each vessel's sections by noise, contrast, blur
/// and calcium about the wall as it is drawn, linear between them. A vessel that runs by itself nowhere keeps
/// `given`'s. `surface_of` is asked from the calling thread. Throws InvalidInput for a bad model, Cancelled.
hemodynamics::WallSpread wall_spread_of_image(const PressureTree& tree, const lumen::LumenModel& model,
                                              const analysis::SurfaceOfVessel& surface_of,
                                              const imaging::ImageVolume& image,
                                              const hemodynamics::WallSpread& given = {},
                                              const analysis::WallSpreadModel& spread = {},
                                              const core::TaskContext& task = core::no_task());

}  // namespace ostia::session
