#pragma once
/// \file A surface's points laid onto another surface (iterative closest point).

#include "ostia/core/task_context.h"
#include "ostia/geometry/aabb_tree.h"
#include "ostia/geometry/rigid_fit.h"

#include <vector>

namespace ostia::evaluation {

double angle_deg(const geometry::RigidFit& motion);  ///< of the rotation, [0, 180]

struct AlignmentOptions {
  int iterations_max = 100;    ///< >= 1
  double tolerance_mm = 1e-6;  ///< done when no point of a step moves further
};

struct RigidAlignment {
  geometry::RigidFit motion;  ///< takes the points onto the surface
  double rms_before_mm = 0.0, rms_mm = 0.0;
  int iterations = 0;
  bool converged = false;
};

/// The rigid motion for which the points' mean square distance to the surface is least, near where they lie.
/// Closest points are found anew in each iteration, as Besl and McKay (IEEE Trans. Pattern Anal. Mach.
/// Intell. 14:239-256, 1992) do it, and the step is that of Gauss and Newton on the distances (Chen and
/// Medioni, Image Vis. Comput. 10:145-155, 1992), damped so that the distance never grows. Throws
/// InvalidInput for fewer than six points, points not finite or bad options; Cancelled.
RigidAlignment align_to(const geometry::AabbTree& surface, const std::vector<geometry::Vec3>& points,
                        const AlignmentOptions& options = {},
                        const core::TaskContext& task = core::no_task());

}  // namespace ostia::evaluation
