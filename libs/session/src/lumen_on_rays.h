#pragma once
/// \file A model's lumen as seen from a vessel's axis.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <cstdint>

namespace ostia::session {

struct Stretch {
  double from_mm = 0.0, to_mm = 0.0;
};

/// Where a vessel runs by itself: behind its take-off, without a radius at its free ends, where the lumen
/// closes or opens to the aorta. `from` may be beyond `to`. Throws InvalidInput for a vessel that is not
/// there.
Stretch stretch_by_itself(const lumen::LumenModel& model, std::int32_t vessel);

/// The model's lumen on rays, at rows about `step_mm` apart; 0.05 mm where it is shut. Where a section's wall
/// is open its neighbours' is taken. `surface_of` is asked from the calling thread. Throws Cancelled.
segmentation::LumenBoundary lumen_on_rays(const lumen::LumenModel& model,
                                          const analysis::SurfaceOfVessel& surface_of, std::int32_t vessel,
                                          const Stretch& stretch, double step_mm, int around,
                                          const core::TaskContext& task);

}  // namespace ostia::session
