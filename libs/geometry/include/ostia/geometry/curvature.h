#pragma once
/// \file How a triangle surface bends (Cohen-Steiner and Morvan, Restricted Delaunay triangulations and
/// normal cycle, SoCG 2003). See docs/methods/meshing.md.

#include "ostia/core/task_context.h"
#include "ostia/geometry/tri_mesh.h"

#include <vector>

namespace ostia::geometry {

/// 1/mm; positive where an outward surface is convex, 1/r on a ball of radius r. `largest` is the one of
/// larger magnitude.
struct PrincipalCurvatures {
  double largest = 0.0, other = 0.0;
};

/// At each point: the curvature tensor, averaged over the points within `reach_mm` of it that the surface
/// joins to it, those near its middle counting most. The larger the reach, the less noise and the blunter
/// what is sharp; below the edges' length the point's own edges alone count. Border points have no say, and
/// what reaches none but them is flat. Deterministic. Throws InvalidInput for a `reach_mm` that is not one a
/// point, not positive or not finite, Cancelled.
std::vector<PrincipalCurvatures> principal_curvatures(const TriMesh& mesh,
                                                      const std::vector<double>& reach_mm,
                                                      const core::TaskContext& task = core::no_task());

}  // namespace ostia::geometry
