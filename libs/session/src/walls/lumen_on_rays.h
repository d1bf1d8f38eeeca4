#pragma once
/// \file A model's lumen as seen from a vessel's axis.

#include "ostia/analysis/lumen_profile.h"
#include "ostia/core/task_context.h"
#include "ostia/lumen/lumen_model.h"
#include "ostia/segmentation/lumen_boundary.h"

#include <cstdint>

namespace ostia::session {

/// A vessel's lumen where it runs by itself.
struct OwnLumen {
  std::int32_t vessel = 0;
  segmentation::LumenBoundary rows;  ///< none where the vessel is shorter than two of them by itself
  double to_mm() const { return rows.from_mm + (rows.rows() - 1) * rows.step_mm; }
};

/// The model's lumen on rays, from where the vessel runs by itself on, at whole steps as far as it does;
/// 0.05 mm where it is shut. Where a section's wall is open its neighbours' is taken. `surface_of` is asked
/// from the calling thread. Throws InvalidInput for a vessel that is not there, and Cancelled.
OwnLumen own_lumen(const lumen::LumenModel& model, const analysis::SurfaceOfVessel& surface_of,
                   std::int32_t vessel, double step_mm, int around, const core::TaskContext& task);

/// Rows [first, last] of others.
segmentation::LumenBoundary rows_between(const segmentation::LumenBoundary& rows, int first, int last);

}  // namespace ostia::session
